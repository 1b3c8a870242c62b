#!/usr/bin/env python3
"""Checks that every #include in sdk/, drivers/ and examples/ obeys layers.txt.

    layers.py ROOT [TABLE]     prints each fault as FILE:LINE: what; exit code 1 when there is one
"""
import os
import re
import sys

TREES = ("sdk", "drivers", "examples")
SOURCES = (".h", ".hpp", ".c", ".cc", ".cpp", ".inl")
ROOTS = ("sdk/include", "sdk/signature/include", "sdk/encryption/include", "sdk", "")  # where a quoted path is looked up, after the file's own folder
INCLUDE = re.compile(r'^\s*#\s*include\s*(?:<([^>]+)>|"([^"]+)")')
COMPUTED = re.compile(r"^\s*#\s*include\s+[^<\"\s]")

STD_C_MIN = {"stddef.h", "stdint.h"}
STD_CPP_INTERFACE = {"cstdio", "cstddef", "cstdint", "memory", "new", "stdexcept", "string", "utility", "vector", "optional", "array"}
STD_C = {"assert.h", "errno.h", "float.h", "inttypes.h", "limits.h", "math.h", "signal.h", "stdbool.h", "stddef.h",
         "stdint.h", "stdio.h", "stdlib.h", "string.h", "time.h"}
POSIX = re.compile(r"^(sys/.+|linux/.+|unistd\.h|fcntl\.h|dirent\.h|poll\.h|pthread\.h|dlfcn\.h|termios\.h)$")
LIBRARIES = {"eigen": re.compile(r"^Eigen/"), "highway": re.compile(r"^hwy/"), "opencv": re.compile(r"^opencv2/"),
             "openni2": re.compile(r"^(OniCAPI|PS1080)\.h$"), "sqlite": re.compile(r"^sqlite3\.h$"),
             "gtest": re.compile(r"^gtest/"), "json": re.compile(r"^nlohmann/"), "posix": POSIX, "turbojpeg": re.compile(r"^turbojpeg\.h$"),
             "openssh_ed25519": re.compile(r"^third_party/openssh_ed25519/"),
             "spng": re.compile(r"^spng\.h$"), "libcamera": re.compile(r"^libcamera/"), "zlib": re.compile(r"^zlib\.h$"),
             "zstd": re.compile(r"^zstd\.h$")}
# The device side makes no calls that need these, however standard they are.
DEVICE_BANNED = {"thread", "mutex", "condition_variable", "future", "atomic", "iostream", "fstream", "sstream", "ostream",
                 "istream", "iomanip", "filesystem", "regex", "stdexcept", "exception", "string", "vector", "map", "set",
                 "unordered_map", "unordered_set", "deque", "list", "memory", "functional", "any", "locale", "chrono",
                 "random", "cstdio", "cstdlib", "stdio.h", "stdlib.h", "ctime", "time.h", "signal.h", "csignal"}


class Row:
    def __init__(self, folder, allowed, libraries):
        self.folder, self.allowed, self.libraries = folder, allowed, libraries

    def match(self, folder):
        """The folder X stands for ('' if the row has none); None when the row is not for this folder."""
        own, path = self.folder.split("/"), folder.split("/")
        if len(path) < len(own):
            return None
        bound = ""
        for want, have in zip(own, path):
            if want == "X":
                bound = have
            elif want != have:
                return None
        return bound

    def permits(self, folder, bound):
        for allowed in [self.folder] + self.allowed:
            allowed = "/".join(bound if part == "X" else part for part in allowed.split("/"))
            if allowed.endswith("/*"):
                allowed = allowed[:-2]
            if folder == allowed or folder.startswith(allowed + "/"):
                return True
        return False


def read_table(path):
    rows = []
    with open(path, encoding="utf-8") as stream:
        for number, line in enumerate(stream, 1):
            line = line.strip()
            if not line or line.startswith("#"):
                continue
            cells = [cell.strip() for cell in line.split("|")]
            if len(cells) != 3:
                raise ValueError(f"{path}:{number}: a row has three cells")
            rows.append(Row(cells[0], cells[1].split(), cells[2].split()))
    return rows


def find_row(rows, folder):
    """The row with the longest match, a named one before one with X."""
    best = None
    for row in rows:
        if row.match(folder) is None:
            continue
        rank = (row.folder.count("/"), "X" not in row.folder.split("/"))
        if best is None or rank > best[0]:
            best = (rank, row)
    return best and best[1]


def resolve(root, source, name):
    """Repository path of an included file of ours; None when it is not ours."""
    for base in (os.path.dirname(source),) + ROOTS:
        path = os.path.normpath(os.path.join(base, name)).replace(os.sep, "/")
        if path.split("/")[0] in TREES and os.path.isfile(os.path.join(root, path)):
            return path
    return None


def check_outside(row, source, name):
    if source.startswith("sdk/include/"):
        fine = STD_C_MIN if source.endswith(".h") else STD_C_MIN | STD_CPP_INTERFACE
        return None if name in fine else f"<{name}> may not stand in the C interface"
    if "any" in row.libraries:
        return None
    for library, pattern in LIBRARIES.items():
        if pattern.match(name):
            return None if library in row.libraries else f"<{name}>: {row.folder} may not use {library}"
    if "/" in name or (name.endswith((".h", ".hpp")) and name not in STD_C):
        return f"<{name}> is of no library that layers.txt knows"
    if source.startswith("sdk/runtime/") and name in DEVICE_BANNED:
        return f"<{name}> has no place on the device"
    return None


def check_include(rows, row, root, source, name):
    target = resolve(root, source, name)
    if target is None:
        if name.split("/")[0] in ("runtime", "host", "lab", "drivers", "spherecloud", "tests"):
            return f'"{name}" is not there'
        return check_outside(row, source, name)
    folder = os.path.dirname(target)
    if find_row(rows, folder) is None:
        return f"includes {target}, whose folder has no row in layers.txt"
    if not row.permits(folder, row.match(os.path.dirname(source))):
        return f"{row.folder} may not include {folder} ({name})"
    return None


def check_file(rows, root, source):
    row = find_row(rows, os.path.dirname(source))
    if row is None:
        return [f"{source}:1: its folder has no row in layers.txt"]
    faults = []
    with open(os.path.join(root, source), encoding="utf-8") as stream:
        for number, line in enumerate(stream, 1):
            found = INCLUDE.match(line)
            if found:
                fault = check_include(rows, row, root, source, found.group(1) or found.group(2))
            else:
                fault = "an #include of a macro cannot be checked" if COMPUTED.match(line) else None
            if fault:
                faults.append(f"{source}:{number}: {fault}")
    return faults


def check_tree(root, table):
    rows, faults, files = read_table(table), [], 0
    for tree in TREES:
        for folder, subfolders, names in os.walk(os.path.join(root, tree)):
            subfolders[:] = sorted(s for s in subfolders if not s.startswith(".") and s not in ("build", "target"))
            for name in sorted(names):
                if name.endswith(SOURCES):
                    files += 1
                    source = os.path.relpath(os.path.join(folder, name), root).replace(os.sep, "/")
                    faults += check_file(rows, root, source)
    return files, faults


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    table = sys.argv[2] if len(sys.argv) == 3 else os.path.join(os.path.dirname(os.path.abspath(__file__)), "layers.txt")
    files, faults = check_tree(sys.argv[1], table)
    for fault in faults:
        print(fault)
    print(f"{files} files, {len(faults)} faults")
    sys.exit(1 if faults or not files else 0)


if __name__ == "__main__":
    main()
