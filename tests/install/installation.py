#!/usr/bin/env python3
"""What an installation holds, whom it refuses, and how it is removed.

    installation.py CHECK --root ROOT --build BUILD --prefix PREFIX --libdir LIBDIR --version VERSION --python PYTHON [--names] [--cmake ARGUMENTS]
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

RUNTIME = ("include/spherecloud/spherecloud.h", "include/spherecloud/spherecloud.hpp", "include/spherecloud/spherecloud_capture.h",
           "include/spherecloud/spherecloud.json", "include/spherecloud/module.modulemap", "{lib}/libspherecloud.a", "{lib}/libspherecloud.so",
           "{lib}/cmake/SphereCloud/SphereCloudConfig.cmake", "{lib}/pkgconfig/spherecloud.pc", "share/doc/spherecloud/LICENSE",
           "share/doc/spherecloud/NOTICE", "include/spherecloud/spherecloud_signature.h", "{lib}/libspherecloud_signature.a",
           "{lib}/pkgconfig/spherecloud-signature.pc", "include/spherecloud/spherecloud_encryption.h",
           "{lib}/libspherecloud_encryption.a", "{lib}/pkgconfig/spherecloud-encryption.pc", "share/doc/spherecloud/spherecloud.spdx.json")
LICENSES_OF_OTHERS = tuple(f"share/doc/spherecloud/{component}/LICENSE.lzfse" for component in ("drivers", "host"))
ALL = RUNTIME + ("bin/spherecloud", *LICENSES_OF_OTHERS, "share/spherecloud/networks", "include/spherecloud/drivers/replay/replay.h", "{lib}/libsphc_driver_replay.a",
                 "{lib}/pkgconfig/spherecloud-drivers.pc", "share/doc/spherecloud/examples/minimal_c/main.c", "include/spherecloud/drivers/contract/contract.cpp")

PLUGIN = "{lib}/libspherecloud_libcamera.so"  # where libcamera-dev was there
PYTHON_PACKAGE = "python3-spherecloud"  # no other way of installing has its files


def missing(needed, prefix, libdir):
    return [f"{name} is not installed" for name in (name.format(lib=libdir) for name in needed) if not (prefix / name).exists()]


def complete(options):
    """Nothing is missing, and no file names the folders of source and build; programs that keep names for a debugger may.
    The command finds the plug-in for libcamera beside it."""
    faults = missing(ALL, options.prefix, options.libdir)
    if (options.prefix / PLUGIN.format(lib=options.libdir)).exists():
        done = subprocess.run([options.prefix / "bin/spherecloud", "devices"], text=True, capture_output=True, check=False)
        if "libspherecloud_libcamera" in done.stdout + done.stderr:
            faults.append(f"the command does not find its plug-in for libcamera: {done.stdout}{done.stderr}")
    for path in options.prefix.rglob("*"):
        content = path.read_bytes() if path.is_file() else b""
        is_code = content.startswith((b"\x7fELF", b"!<arch>"))
        faults += [f"{path} names {folder}" for folder in (options.root, options.build)
                   if str(folder).encode() in content and not (is_code and options.names)]
    return faults


def pages(options):
    """Every page that a header, a help text or a message names is installed."""
    docs = options.prefix / "share/doc/spherecloud"
    files = [path for path in options.prefix.rglob("*") if path.is_file() and docs / "docs" not in path.parents]
    named = {(page.decode(), path) for path in files for page in re.findall(rb"docs/[\w/-]+\.md", path.read_bytes())}
    named_by = {path.relative_to(options.prefix).parts[0] for page, path in named}
    faults = [f"{path} names {page}, which is not installed" for page, path in sorted(named) if not (docs / page).is_file()]
    faults += [f"no file of {folder} names a page" for folder in ("bin", "include") if folder not in named_by]
    return faults


ASKS = """cmake_minimum_required(VERSION 3.25)
project(asks LANGUAGES CXX)
get_cmake_property(before VARIABLES)
find_package(SphereCloud %s)
get_cmake_property(after VARIABLES)
list(REMOVE_ITEM after before ${before})
list(FILTER after EXCLUDE REGEX "^SphereCloud_")
message(STATUS "found: ${SphereCloud_FOUND}, new variables: '${after}'")
"""


def find(arguments, prefix):
    """What CMake says to find_package(SphereCloud ARGUMENTS), and whether it went on."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "CMakeLists.txt").write_text(
            ASKS % arguments, encoding="utf-8")
        done = subprocess.run(["cmake", "-S", folder, "-B", folder + "/build", "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={prefix}"],
                              text=True, capture_output=True, check=False)
    return " ".join((done.stdout + done.stderr).split()), done.returncode == 0


def refusals(options):
    """Versions and components that are not there are refused with a cause; those that are there are not."""
    version = f"{options.prefix}/{options.libdir}/cmake/SphereCloud/SphereCloudConfig.cmake, version: {options.version}"
    major, minor, patch = map(int, options.version.split("."))
    mine, other, next_minor = f"{major}.{minor}", f"{major + 1}.0", f"{major}.{minor + 1}"
    unknown = 'SphereCloud has no component "gpu"; its components are runtime, signature, encryption, drivers, host.'
    cases = [(f"{next_minor} REQUIRED", version), (f"{other} REQUIRED", version), (f"{mine}.{patch + 1} REQUIRED", version),
             ("REQUIRED COMPONENTS gpu", unknown), ("REQUIRED COMPONENTS drivers gpu", unknown),
             ("REQUIRED COMPONENTS runtime signature encryption drivers host OPTIONAL_COMPONENTS gpu", None), (f"{mine} REQUIRED", None), (f"{options.version} EXACT REQUIRED", None)]
    cases.append(("0.2 REQUIRED", version))  # before the interface was frozen
    faults = []
    for arguments, why in cases:
        said, went_on = find(arguments, options.prefix)
        if went_on != (why is None) or (why or "found: 1, new variables: ''") not in said:
            faults.append(f"find_package(SphereCloud {arguments}) says: {said}")
    cures = {"host": "build and install it with -DSPHC_HOST=ON.", "signature": 'install the component "signature" too.'}
    for component, cure in cures.items():
        with tempfile.TemporaryDirectory(dir=options.prefix.parent) as place:
            partial = Path(place) / "prefix"
            shutil.copytree(options.prefix, partial, symlinks=True, copy_function=os.link)
            (partial / options.libdir / "cmake" / "SphereCloud" / f"SphereCloud-{component}.cmake").unlink()
            said, went_on = find(f"REQUIRED COMPONENTS {component}", partial)
        if went_on or f'the component "{component}" is not in this installation of SphereCloud; {cure}' not in said:
            faults.append(f"without the component {component} find_package says: {said}")
    return faults


def staged(options):
    """DESTDIR and CMAKE_INSTALL_LIBDIR are respected, and uninstalling leaves nothing but what others put there."""
    folder = options.prefix.parent / "staged"
    shutil.rmtree(folder, ignore_errors=True)
    build, root, libdir = folder / "build", folder / "root", "lib64/of_this"
    prefix, environment = root / "opt" / "other", dict(os.environ, DESTDIR=str(root))

    def cmake(*arguments):
        return subprocess.run(["cmake", *arguments], env=environment, text=True, capture_output=True, check=False)

    def done(*arguments):
        run = cmake(*arguments)
        if run.returncode:
            sys.exit(f"cmake {arguments} fails:\n{run.stdout}{run.stderr}")

    done("-S", options.root, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_INSTALL_PREFIX=/opt/other",
         f"-DCMAKE_INSTALL_LIBDIR={libdir}", *(f"-DSPHC_{part}=OFF" for part in ("HOST", "DRIVERS", "EXAMPLES", "TESTS")), *options.cmake.split())
    done("--build", build)
    done("--install", build)
    faults = missing(RUNTIME, prefix, libdir)
    faults += [f"{path} is installed, whose code is not" for path in prefix.rglob("LICENSE.*")]
    asked = subprocess.run(["pkg-config", "--variable=libdir", "spherecloud"], env=dict(environment, PKG_CONFIG_PATH=f"{prefix}/{libdir}/pkgconfig"),
                           text=True, capture_output=True, check=False)
    if not asked.stdout or not Path(asked.stdout.strip()).samefile(prefix / libdir):
        faults.append(f"pkg-config says that libraries are in {asked.stdout} {asked.stderr}")
    said, went_on = find("REQUIRED", prefix / libdir / "cmake" / "SphereCloud")
    if not went_on:
        faults.append(f"from another folder of libraries find_package says: {said}")

    (prefix / "include" / "of_others.h").touch()
    for again in ((), ("--component", "runtime")):
        if again:
            done("--install", build, *again)
        done("--build", build, "--target", "uninstall")
        left = sorted(str(path.relative_to(prefix)) for path in prefix.rglob("*"))
        if left != ["include", "include/of_others.h"]:
            faults.append(f"uninstalling leaves {left} {again}")
    again = cmake("--build", build, "--target", "uninstall")
    if again.returncode == 0 or "nothing to uninstall" not in again.stdout + again.stderr:
        faults.append(f"uninstalling once more says: {again.stdout}{again.stderr}")
    return faults


def told_in_full(options):
    """Folders of libraries and headers that are absolute, as some distributions have them, are where pkg-config says."""
    folder = options.prefix.parent / "told in full"
    shutil.rmtree(folder, ignore_errors=True)
    wanted = {"libdir": "/opt/of this/lib", "includedir": "/opt/of this/headers"}  # nothing is installed
    done = subprocess.run(["cmake", "-S", options.root, "-B", folder / "build", "-G", "Ninja", *(f"-DSPHC_{part}=OFF" for part in ("HOST", "DRIVERS", "EXAMPLES", "TESTS")),
                           *(f"-DCMAKE_INSTALL_{name.upper()}={path}" for name, path in wanted.items())], text=True, capture_output=True, check=False)
    if done.returncode:
        return [done.stdout + done.stderr]
    packages_told = [path.stem for path in (folder / "build/install").glob("*.pc")]
    faults = [] if "spherecloud" in packages_told else [f"pkg-config is told of {packages_told}"]
    environment = dict(os.environ, PKG_CONFIG_PATH=str(folder / "build/install"))
    for package in packages_told:
        for name, path in wanted.items():
            said = subprocess.run(["pkg-config", f"--variable={name}", package], env=environment, text=True, capture_output=True, check=False)
            if said.stdout.replace("\\ ", " ").strip() != path:
                faults.append(f"{package}: {name} is {said.stdout}{said.stderr} instead of {path}")
    return faults


LINKS = """cmake_minimum_required(VERSION 3.25)
project(links LANGUAGES CXX)
find_package(SphereCloud REQUIRED)
file(WRITE links.cpp "#include <spherecloud/spherecloud.h>\\nint main() { return sphc_abi() == SPHC_ABI ? 0 : 1; }")
add_executable(links links.cpp)
target_link_libraries(links PRIVATE SphereCloud::spherecloud)
"""


def highway_elsewhere(options):
    """The static library is linked with Highway where CMake and pkg-config know it from, though no linker looks there."""
    told = subprocess.run(["pkg-config", "--variable=libdir", "libhwy"], text=True, capture_output=True, check=False)
    if "-lhwy" not in (options.prefix / options.libdir / "pkgconfig/spherecloud.pc").read_text(encoding="utf-8"):
        return []  # single lanes, or what the compiler's flags allow: headers alone
    folder = options.prefix.parent / "highway_elsewhere"
    shutil.rmtree(folder, ignore_errors=True)
    libdir = folder / "highway/lib"
    (libdir / "pkgconfig").mkdir(parents=True)
    (libdir / "libhwy.so").symlink_to(Path(told.stdout.strip()) / "libhwy.so")
    (libdir / "pkgconfig/libhwy.pc").write_text(
        f"libdir={libdir}\nName: libhwy\nDescription: Highway, elsewhere\nVersion: 1.0.3\nLibs: -L${{libdir}} -lhwy\n", encoding="utf-8")

    def cmake(*arguments):
        return subprocess.run(["cmake", *arguments], env=dict(os.environ, PKG_CONFIG_PATH=str(libdir / "pkgconfig")), text=True, capture_output=True, check=False)

    (folder / "CMakeLists.txt").write_text(LINKS, encoding="utf-8")
    runs = [cmake("-S", folder, "-B", folder / "links", "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={options.prefix};{folder / 'highway'}"),
            cmake("--build", folder / "links"),
            cmake("-S", options.root, "-B", folder / "build", "-G", "Ninja", *(f"-DSPHC_{part}=OFF" for part in ("HOST", "DRIVERS", "EXAMPLES", "TESTS")))]
    faults = [run.stdout + run.stderr for run in runs if run.returncode]
    if faults:
        return faults
    if f"{libdir}/libhwy.so" not in (folder / "links/build.ninja").read_text(encoding="utf-8"):
        faults.append(f"find_package takes another Highway than that of CMAKE_PREFIX_PATH, {libdir}")
    flags = subprocess.run(["pkg-config", "--static", "--libs", "spherecloud"], env=dict(os.environ, PKG_CONFIG_PATH=str(folder / "build/install")),
                           text=True, capture_output=True, check=False).stdout
    if f"-L{libdir} -lhwy" not in flags:
        faults.append(f"pkg-config does not say where Highway is that the library was built with: {flags}")
    return faults


def made_into(folder, options):
    """{name of a package: its bytes}, made at a time of their own, and dated by SOURCE_DATE_EPOCH."""
    subprocess.run(["cpack", "--config", options.build / "CPackConfig.cmake", "-B", folder], check=True, capture_output=True,
                   env=dict(os.environ, SOURCE_DATE_EPOCH="1700000000"))
    return {file.name: file.read_bytes() for file in folder.glob("*.deb")}


def packages(options):
    """The Debian packages hold each installed file once, depend on each other, and are found when unpacked and by dpkg-shlibdeps."""
    folder = options.prefix.parent / "packages"
    shutil.rmtree(folder, ignore_errors=True)
    once, again = (made_into(folder / name, options) for name in ("once", "again"))
    library = "libspherecloud" + options.version.split(".")[0]
    depends = {library: "libc6", "libspherecloud-dev": library, "libspherecloud-drivers-dev": "libspherecloud-dev", "libspherecloud-signature-dev": "libspherecloud-dev",
               "libspherecloud-encryption-dev": "libspherecloud-dev", "spherecloud-tools": library,
               PYTHON_PACKAGE: library, "spherecloud-doc": ""}
    if (options.prefix / PLUGIN.format(lib=options.libdir)).exists():
        depends["spherecloud-libcamera"] = "libcamera"
    faults, owners = [f"{name} has other bytes when it is made again" for name in once if once[name] != again[name]], {}
    for package, other in depends.items():
        file, = (folder / "once").glob(f"{package}_{options.version}*_*.deb")
        asked = subprocess.run(["dpkg-deb", "-f", file, "Depends"], text=True, capture_output=True, check=True).stdout
        if other not in asked:
            faults.append(f"{package} does not depend on {other}: {asked}")
        unpacked = folder / package
        subprocess.run(["dpkg-deb", "-x", file, unpacked], check=True)
        subprocess.run(["dpkg-deb", "-x", file, folder / "root"], check=True)
        for name in names_in(unpacked / "usr"):
            owners.setdefault(name, []).append(package)
    file, = (folder / "once").glob(f"{library}_*.deb")
    told = subprocess.run(["dpkg-deb", "-I", file, "shlibs"], text=True, capture_output=True, check=False).stdout
    if not told.startswith(f"libspherecloud {options.version.split('.')[0]} {library} (>= {options.version}"):
        faults.append(f"{library} does not say on what packages of programs depend that are linked with it: {told or 'no shlibs'}")
    faults += [f"{name} is in {who}" for name, who in owners.items() if len(who) > 1]
    installed = {name for name, who in owners.items() if who != [PYTHON_PACKAGE]}
    faults += [f"{name} is installed and in no package, or the other way round" for name in names_in(options.prefix) ^ installed]
    said, went_on = find("REQUIRED COMPONENTS signature encryption drivers host", folder / "root" / "usr")
    if not went_on:
        faults.append(f"from the unpacked packages find_package says: {said}")
    return faults + python_faults(options, folder / "root" / "usr")


def python_faults(options, usr):
    """The unpacked Python package finds the library beside it, and runs the command."""
    environment = dict(os.environ, PYTHONPATH=str(usr / "lib/python3/dist-packages"), LD_LIBRARY_PATH=str(usr / options.libdir),
                       PATH=f"{usr / 'bin'}:{os.environ['PATH']}")
    environment.pop("SPHERECLOUD_LIBRARY", None)
    asks = "import spherecloud; print(spherecloud.__file__, spherecloud.version())"
    wanted = {("-c", asks): f"{usr}/lib/python3/dist-packages/spherecloud/__init__.py {options.version}",
              ("-m", "spherecloud", "--version"): f"spherecloud {options.version}"}
    faults = []
    for words, answer in wanted.items():
        done = subprocess.run([options.python, "-B", *words], env=environment, text=True, capture_output=True, check=False)
        if done.returncode or not done.stdout.startswith(answer):
            faults.append(f"python {' '.join(words)} says: {done.stdout}{done.stderr} instead of {answer}")
    return faults


def names_in(folder):
    return {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_symlink() or path.is_file()}


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    checks = {check.__name__: check for check in (complete, pages, refusals, staged, told_in_full, highway_elsewhere, packages)}
    parser.add_argument("check", choices=checks)
    parser.add_argument("--root", type=Path, required=True)
    parser.add_argument("--build", type=Path, required=True)
    parser.add_argument("--prefix", type=Path, required=True)
    parser.add_argument("--libdir", required=True)
    parser.add_argument("--version", required=True)
    parser.add_argument("--python", type=Path, required=True, help="one that has numpy")
    parser.add_argument("--names", action="store_true", help="the code may name its source: no release")
    parser.add_argument("--cmake", default="", help="more arguments for cmake where the tree is built")
    chosen = parser.parse_args()
    found = checks[chosen.check](chosen)
    print("\n".join(found))
    sys.exit(1 if found else 0)
