#!/usr/bin/env python3
"""What an installation holds, whom it refuses, and how it is removed.

    installation.py CHECK --root ROOT --build BUILD --prefix PREFIX --libdir LIBDIR [--names]
"""
import argparse
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

NEEDED = ("bin/spherecloud", "include/spherecloud/spherecloud.h", "include/spherecloud/spherecloud.hpp",
          "include/spherecloud/spherecloud_capture.h", "include/spherecloud/spherecloud.json", "include/spherecloud/drivers/replay/replay.h",
          "{lib}/libspherecloud.a", "{lib}/libspherecloud.so", "{lib}/libspherecloud.so.0", "{lib}/cmake/SphereCloud/SphereCloudConfig.cmake",
          "{lib}/pkgconfig/spherecloud.pc", "share/doc/spherecloud/LICENSE", "share/doc/spherecloud/NOTICE", "share/spherecloud/networks")


def missing(prefix, libdir):
    return [name for name in (name.format(lib=libdir) for name in NEEDED) if not (prefix / name).exists()]


def complete(options):
    """Nothing is missing, and no file names the folders of source and build; programs that keep names for a debugger may."""
    faults = [f"{name} is not installed" for name in missing(options.prefix, options.libdir)]
    for path in options.prefix.rglob("*"):
        content = path.read_bytes() if path.is_file() else b""
        is_code = content.startswith((b"\x7fELF", b"!<arch>"))
        faults += [f"{path} names {folder}" for folder in (options.root, options.build)
                   if str(folder).encode() in content and not (is_code and options.names)]
    return faults


def find(arguments, prefix):
    """What CMake says to find_package(SphereCloud ARGUMENTS), and whether it went on."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "CMakeLists.txt").write_text(
            f"cmake_minimum_required(VERSION 3.25)\nproject(asks LANGUAGES CXX)\nfind_package(SphereCloud {arguments})\n"
            'message(STATUS "found: ${SphereCloud_FOUND}")\n', encoding="utf-8")
        done = subprocess.run(["cmake", "-S", folder, "-B", folder + "/build", "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={prefix}"],
                              text=True, capture_output=True, check=False)
    return " ".join((done.stdout + done.stderr).split()), done.returncode == 0


def refusals(options):
    """Versions and components that are not there are refused with a cause; those that are there are not."""
    version = f"{options.prefix}/{options.libdir}/cmake/SphereCloud/SphereCloudConfig.cmake, version: 0.2.0"
    unknown = 'SphereCloud has no component "gpu"; its components are runtime, drivers, host.'
    cases = [("0.1 REQUIRED", version), ("0.3 REQUIRED", version), ("1.0 REQUIRED", version), ("0.2.1 REQUIRED", version),
             ("0.2 REQUIRED COMPONENTS gpu", unknown), ("0.2 REQUIRED COMPONENTS drivers gpu", unknown),
             ("0.2 REQUIRED COMPONENTS runtime drivers host OPTIONAL_COMPONENTS gpu", None), ("REQUIRED", None), ("0.2.0 EXACT REQUIRED", None)]
    faults = []
    for arguments, why in cases:
        said, went_on = find(arguments, options.prefix)
        if went_on != (why is None) or (why or "found: ") not in said:
            faults.append(f"find_package(SphereCloud {arguments}) says: {said}")
    with tempfile.TemporaryDirectory(dir=options.prefix.parent) as place:
        partial = Path(place) / "prefix"
        shutil.copytree(options.prefix, partial, symlinks=True, copy_function=os.link)
        (partial / options.libdir / "cmake" / "SphereCloud" / "SphereCloud-host.cmake").unlink()
        said, went_on = find("REQUIRED COMPONENTS host", partial)
    if went_on or 'the component "host" is not in this installation of SphereCloud; build and install it with -DSPHC_HOST=ON.' not in said:
        faults.append(f"without the host find_package says: {said}")
    return faults


def uninstall(options):
    """DESTDIR is respected, and uninstalling leaves nothing there but what others put there."""
    with tempfile.TemporaryDirectory() as place:
        staged = Path(place).resolve() / "staged"
        prefix, environment = staged / "usr" / "other", dict(os.environ, DESTDIR=str(staged))
        script = options.root / "toolchains" / "install" / "uninstall.cmake"
        subprocess.run(["cmake", "--install", options.build, "--prefix", "/usr/other"], env=environment, check=True, capture_output=True)
        faults = [f"with DESTDIR {name} is not installed" for name in missing(prefix, options.libdir)]
        (prefix / "include" / "of_others.h").touch()
        subprocess.run(["cmake", f"-DBUILD={options.build}", "-P", script], env=environment, check=True, capture_output=True)
        left = [str(path.relative_to(prefix)) for path in prefix.rglob("*")]
        if left != ["include", "include/of_others.h"]:
            faults.append(f"uninstalling leaves {left}")
        again = subprocess.run(["cmake", f"-DBUILD={options.build}", "-P", script], text=True, capture_output=True, check=False)
        if again.returncode == 0 or "nothing to uninstall" not in again.stderr:
            faults.append(f"uninstalling once more says: {again.stderr}")
    return faults


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    checks = {check.__name__: check for check in (complete, refusals, uninstall)}
    parser.add_argument("check", choices=checks)
    parser.add_argument("--root", type=Path, required=True)
    parser.add_argument("--build", type=Path, required=True)
    parser.add_argument("--prefix", type=Path, required=True)
    parser.add_argument("--libdir", required=True)
    parser.add_argument("--names", action="store_true", help="the code may name its source: no release")
    chosen = parser.parse_args()
    found = checks[chosen.check](chosen)
    print("\n".join(found))
    sys.exit(1 if found else 0)
