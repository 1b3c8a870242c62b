#!/usr/bin/env python3
"""Builds the wheel, with nothing but Python; pip calls it too (pyproject.toml).

    build_wheel.py [--out FOLDER] [--library LIBSPHERECLOUD.SO] [--command SPHERECLOUD]

With a library (or SPHERECLOUD_LIBRARY) the wheel carries it, and what it needs that no system must have, and its tag
says which machines have the rest: glibc, libstdc++.  Without one it is for any machine, and finds the installed
library.  A command that needs libraries of this machine makes a wheel for this machine (linux, not manylinux).  The same
files and SOURCE_DATE_EPOCH give the same bytes.
"""
import argparse
import base64
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import time
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
# What a manylinux machine has.
SYSTEM = re.compile(r"(ld-linux.*|linux-vdso|libc|libm|libdl|libpthread|librt|libstdc\+\+|libgcc_s)\.so")
# The glibc that a tag of manylinux names, and the youngest symbols of the machine's libstdc++ and libgcc that a wheel of
# this tag may ask for: of all kinds of machine the least that auditwheel 6 allows.
MANYLINUX = [((2, 17), {"GLIBCXX": (3, 4, 19), "CXXABI": (1, 3, 7), "GCC": (4, 7, 0)}),
             ((2, 24), {"GLIBCXX": (3, 4, 22), "CXXABI": (1, 3, 10), "GCC": (4, 7, 0)}),
             ((2, 27), {"GLIBCXX": (3, 4, 24), "CXXABI": (1, 3, 11), "GCC": (7, 0, 0)}),
             ((2, 31), {"GLIBCXX": (3, 4, 28), "CXXABI": (1, 3, 12), "GCC": (7, 0, 0)}),
             ((2, 34), {"GLIBCXX": (3, 4, 29), "CXXABI": (1, 3, 13), "GCC": (7, 0, 0)}),
             ((2, 35), {"GLIBCXX": (3, 4, 30), "CXXABI": (1, 3, 13), "GCC": (7, 0, 0)}),
             ((2, 39), {"GLIBCXX": (3, 4, 33), "CXXABI": (1, 3, 15), "GCC": (14, 0, 0)})]
# What a tag calls the machine of an ELF file, by its header: 1 for 32 bits or 2 for 64, and the number of the processor.
MACHINES = {(1, 3): "i686", (1, 40): "armv7l", (2, 62): "x86_64", (2, 183): "aarch64", (2, 243): "riscv64"}


def told(key):
    """A value of pyproject.toml; versions of Python before 3.11 cannot read the whole of it."""
    found = re.search(rf'^{re.escape(key)} = "(.*)"$', (HERE / "pyproject.toml").read_text(encoding="utf-8"), re.MULTILINE)
    return found.group(1)


def needed_by(library):
    """The files that a library needs and that not every system has: [(name, path)]."""
    ldd = subprocess.run(["ldd", library], capture_output=True, text=True)
    if ldd.returncode:
        why = (ldd.stderr or ldd.stdout).strip()
        sys.exit(f"{library} cannot go into a wheel ({why}); build it, and name the file that the build made")
    pairs = [line.split(" => ") for line in ldd.stdout.splitlines() if " => " in line]
    found = [(name.strip(), path.rpartition(" (")[0].strip()) for name, path in pairs]
    missing = [name for name, path in found if "not found" in path or not path]
    if missing:
        sys.exit(f"{library} needs {', '.join(missing)}, which this system has not; install it")
    return [(name, path) for name, path in found if not SYSTEM.match(name)]


def licenses(carried, command):
    """{name: bytes} of the project's licence, and of the carried libraries as Debian keeps them."""
    found = {name: (ROOT / name).read_bytes() for name in ("LICENSE", "NOTICE")}
    if command:  # it reads depth of Record3D
        found["LICENSE.lzfse"] = (ROOT / "third_party/lzfse/LICENSE").read_bytes()
    for name, _ in carried[1:]:
        package = name.replace(".so.", "")  # libhwy.so.1 is of libhwy1
        text = pathlib.Path(f"/usr/share/doc/{package}/copyright")
        if not text.exists():
            sys.exit(f"{text}, the licence of {name}, is missing; a wheel that carries the library needs it")
        found[package] = text.read_bytes()
    return found


def asked_of(files):
    """{"GLIBC", "GLIBCXX" and so on: the youngest version of its symbols that one of the files asks for}"""
    asked = {}
    for path in files:
        content = pathlib.Path(path).read_bytes()
        if b"\0GLIBC_ABI_DT_RELR\0" in content:
            asked["GLIBC"] = max(asked.get("GLIBC", (0,)), (2, 36))
        for name, text in re.findall(rb"\0(GLIBC|GLIBCXX|CXXABI|GCC)_(\d+(?:\.\d+)*)(?=\0)", content):
            version = tuple(int(part) for part in text.decode().split("."))
            asked[name.decode()] = max(asked.get(name.decode(), (0,)), version)
    return asked


def platform_of(files):
    """manylinux_X_Y of the oldest machines that have all that the files ask for; linux where no tag promises that."""
    asked = asked_of(files)
    glibc = asked.pop("GLIBC", (0,))[:2]
    for of_tag, youngest in MANYLINUX:
        if all(version <= youngest[name] for name, version in asked.items()):
            major, minor = max(of_tag, glibc)
            return f"manylinux_{major}_{minor}"
    return "linux"


def machine_of(path):
    """The machine that a file is for, which need not be the kernel's: a kernel of 64 bits runs systems of 32."""
    content = pathlib.Path(path).read_bytes()[:20]
    header = (content[4], int.from_bytes(content[18:], "little")) if content[:4] == b"\x7fELF" and len(content) == 20 else None
    if header not in MACHINES:
        sys.exit(f"{path} is for none of {', '.join(MACHINES.values())}; build it for one of them, or a wheel without --library")
    return MACHINES[header]


def tag_of(carried, command):
    """py3-none-PLATFORM_MACHINE; a command that needs more than is carried may not run on another machine."""
    if not carried and not command:
        return "py3-none-any"
    names = [name for name, _ in carried]
    is_alone = command and any(name not in names and not (carried and name.startswith("libspherecloud."))
                               for name, _ in needed_by(command))
    platform = "linux" if is_alone else platform_of([path for _, path in carried] + [command] * bool(command))
    return f"py3-none-{platform}_{machine_of(carried[0][1] if carried else command)}"


def metadata():
    lines = ["Metadata-Version: 2.4", f"Name: {told('name')}", f"Version: {told('version')}", f"Summary: {told('description')}",
             f"License-Expression: {told('license')}", "License-File: LICENSE", "License-File: NOTICE",
             f"Requires-Python: {told('requires-python')}", "Requires-Dist: numpy>=1.22", "Provides-Extra: views",
             'Requires-Dist: matplotlib; extra == "views"', "Provides-Extra: rerun",
             'Requires-Dist: rerun-sdk>=0.23; extra == "rerun"', "Description-Content-Type: text/markdown", ""]
    return "\n".join(lines) + "\n" + (HERE / "README.md").read_text(encoding="utf-8")


def contents(library, command):
    """({name in the wheel: bytes}, tag)"""
    files = {str(path.relative_to(HERE)): path.read_bytes() for path in sorted((HERE / "spherecloud").rglob("*"))
             if path.suffix == ".py" or path.name == "py.typed"}
    carried = [("libspherecloud.so", library), *needed_by(library)] if library else []
    files.update({f"spherecloud/lib/{name}": pathlib.Path(path).read_bytes() for name, path in carried})
    tag = tag_of(carried, command)
    if command:
        files["spherecloud/bin/spherecloud"] = pathlib.Path(command).read_bytes()
    info = f"{told('name')}-{told('version')}.dist-info"
    files[f"{info}/METADATA"] = metadata().encode()
    pure = "true" if tag.endswith("any") else "false"
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: build_wheel.py\nRoot-Is-Purelib: {pure}\nTag: {tag}\n".encode()
    files.update({f"{info}/licenses/{name}": text for name, text in licenses(carried, command).items()})
    rows = [f"{name},sha256={base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b'=').decode()},{len(data)}"
            for name, data in files.items()]
    files[f"{info}/RECORD"] = ("\n".join([*rows, f"{info}/RECORD,,"]) + "\n").encode()
    return files, tag


def write(folder, files, tag):
    """The wheel's path."""
    when = time.gmtime(max(int(os.environ.get("SOURCE_DATE_EPOCH", "315532800")), 315532800))[:6]  # a zip begins in 1980
    path = pathlib.Path(folder) / f"{told('name')}-{told('version')}-{tag}.whl"
    path.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(path, "w") as wheel:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, when)
            entry.compress_type, entry.create_system = zipfile.ZIP_DEFLATED, 3
            entry.external_attr = (0o100755 if "/bin/" in name else 0o100644) << 16
            wheel.writestr(entry, data)
    return path


# ---- what pip calls ----

def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    return write(wheel_directory, *contents(os.environ.get("SPHERECLOUD_LIBRARY"), None)).name


def build_sdist(sdist_directory, config_settings=None):
    raise NotImplementedError("the package is built from the sources of the SDK")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", default="dist")
    parser.add_argument("--library", default=os.environ.get("SPHERECLOUD_LIBRARY"))
    parser.add_argument("--command")
    arguments = parser.parse_args()
    print(write(arguments.out, *contents(arguments.library, arguments.command)))
