#!/usr/bin/env python3
"""Checks that every source of sdk/ and drivers/ has a test that a reader can find, and that every test is compiled.

    mirror.py ROOT [LIST]     prints each source without one, and each test that is not; exit code 1 when there is one

A source a/b.cpp has its test in tests/unit/a/b_test.cpp (sdk/ left out); b_scalar.cpp and b_simd.cpp, the same code for
several instruction sets, share that of b.  sdk/runtime/capi/b.cpp may have it in tests/capi/b_test.cpp, by the C interface.
Otherwise some test includes its header a/b.h, or the list, mirror.txt beside this file, says which test runs it:
"source-or-folder: test".  A line of the list that is not needed, or names no file, is a fault too.
A test tests/**/a_test.cpp is compiled where a CMakeLists.txt names it.
"""
import os
import pathlib
import re
import sys

SOURCES = (".c", ".cpp")
C_INTERFACE = pathlib.PurePath("runtime/capi")
TEST = re.compile(r"[\w./-]+_test\.cpp")
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)


def sources(root):
    for tree in ("sdk", "drivers"):
        for path in sorted((root / tree).rglob("*")):
            if path.suffix in SOURCES and path.is_file():
                yield path.relative_to(root)


def included(root):
    """Every quoted path that a test includes; `beside` files are found by their own folder's path too."""
    found = set()
    for path in (root / "tests").rglob("*"):
        if path.suffix in (".c", ".cpp", ".h"):
            found.update(INCLUDE.findall(path.read_text(errors="replace")))
    return found


def inside(source):
    """The path as #include says it: sdk/ is where quoted paths begin."""
    return pathlib.PurePath(*source.parts[1:]) if source.parts[0] == "sdk" else pathlib.PurePath(source)


def is_mirrored(root, source, includes):
    path = inside(source)
    test = re.sub("_(scalar|simd)$", "", path.stem) + "_test.cpp"
    folders = [pathlib.Path("unit") / path.parent] + ([pathlib.Path("capi")] if path.parent == C_INTERFACE else [])
    return any((root / "tests" / folder / test).is_file() for folder in folders) or any(str(path.with_suffix(suffix)) in includes for suffix in (".h", ".hpp"))


def read_list(path):
    for number, line in enumerate(path.read_text().splitlines(), 1):
        line = line.split("#")[0].strip()
        if line:
            name, _, test = line.partition(":")
            yield number, pathlib.PurePath(name.strip()), test.strip()


def not_compiled(root):
    """Tests that no CMakeLists.txt names, by their path from its folder."""
    named = {os.path.normpath(lists.parent / name) for lists in (root / "tests").rglob("CMakeLists.txt") for name in TEST.findall(lists.read_text())}
    return sorted(path.relative_to(root) for path in (root / "tests").rglob("*_test.cpp") if str(path) not in named)


def faults(root, listed):
    includes = included(root)
    needed = {source for source in sources(root) if not is_mirrored(root, source, includes)}
    covered = set()
    for number, name, test in read_list(listed):
        mine = {source for source in needed if source == name or name in source.parents}
        if not test or not (root / "tests" / test).exists():
            yield "%s:%d: there is no tests/%s" % (listed.name, number, test)
        if not mine - covered:
            yield "%s:%d: %s needs no line" % (listed.name, number, name)
        covered |= mine
    for source in sorted(needed - covered):
        yield "%s: no test of its name, none that includes its header, no line in %s" % (source, listed.name)
    for test in not_compiled(root):
        yield "%s: no CMakeLists.txt names it, so it is not compiled" % test


def main(arguments):
    root = pathlib.Path(arguments[0]).resolve()
    found = list(faults(root, pathlib.Path(arguments[1]) if len(arguments) > 1 else pathlib.Path(__file__).with_name("mirror.txt")))
    print("\n".join(found) if found else "every source has a test, and every test is compiled")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
