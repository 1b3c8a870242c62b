#!/usr/bin/env python3
"""The packages of the Java binding; the same input gives the same bytes.

    package.py jar OUT.jar CLASSES                      CLASSES: the folder that javac wrote
    package.py aar OUT.aar CLASSES ABI=FOLDER...        ABI: arm64-v8a, x86_64, ...
                                                        FOLDER: has libspherecloud_jni.so and libspherecloud.a

An AAR has the jar, the JNI library of each ABI, and, in the layout of prefab, the C headers with the static library, so
that an app's own C or C++ finds them by find_package(spherecloud).
"""
import io
import json
import re
import sys
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
HEADERS = ROOT / "sdk" / "include" / "spherecloud"
VERSION = re.search(r'VERSION = "(.*)"', (HERE / "src/generated/java/org/spherecloud/Release.java").read_text()).group(1)
API = 28  # the first Android that has java.lang.ref.Reference.reachabilityFence
# What the header of an ELF file says of the processor, for each ABI.
MACHINES = {"arm64-v8a": 183, "armeabi-v7a": 40, "riscv64": 243, "x86": 3, "x86_64": 62}
MANIFEST = f"""Manifest-Version: 1.0
Automatic-Module-Name: org.spherecloud
Bundle-License: Apache-2.0
Implementation-Title: spherecloud
Implementation-Version: {VERSION}

"""


def zip_of(entries):
    """Bytes of a zip with these (name, bytes), in this order, of no time."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in entries:
            info = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            info.compress_type = zipfile.ZIP_DEFLATED
            info.external_attr = 0o644 << 16
            archive.writestr(info, data)
    return stream.getvalue()


def text(words):
    return words.encode("utf-8")


def jar(classes):
    entries = [("META-INF/MANIFEST.MF", text(MANIFEST.replace("\n", "\r\n"))),
               ("META-INF/LICENSE", (ROOT / "LICENSE").read_bytes()), ("META-INF/NOTICE", (ROOT / "NOTICE").read_bytes()),
               ("META-INF/maven/org.spherecloud/spherecloud/pom.xml", (HERE / "pom.xml").read_bytes())]
    files = sorted(Path(classes).rglob("*.class"))
    if not files:
        sys.exit(f"package.py: no classes in {classes}; compile first")
    return zip_of(entries + [(path.relative_to(classes).as_posix(), path.read_bytes()) for path in files])


def members(archive):
    """The files in an archive of objects."""
    at = 8
    while archive[at + 58:at + 60] == b"`\n":
        size = int(archive[at + 48:at + 58])
        yield archive[at + 60:at + 60 + size]
        at += 60 + size + size % 2


def machine(data):
    """The processor that an ELF file is for, or the first one in an archive; None where there is none."""
    files = members(data) if data[:8] == b"!<arch>\n" else [data]
    return next((int.from_bytes(file[18:20], "little") for file in files if file[:4] == b"\x7fELF"), None)


def library(abi, folder, name):
    """Its bytes, if it is of this ABI."""
    path = Path(folder) / name
    if abi not in MACHINES:
        sys.exit(f"package.py: Android has no ABI {abi}; it has {', '.join(MACHINES)}")
    if not path.is_file():
        sys.exit(f"package.py: there is no {path}; build it for {abi} and put it there")
    data = path.read_bytes()
    found = machine(data)
    if found != MACHINES[abi]:
        of = {number: "of " + name for name, number in MACHINES.items()}.get(found, "no library of Android")
        sys.exit(f"package.py: {path} is {of}, not of {abi}; build it with -DANDROID_ABI={abi}, or name its own ABI")
    return data


def prefab(folders):
    """The C library as Gradle hands it to CMake: static, and without a need of the C++ library."""
    module = "prefab/modules/spherecloud"
    yield "prefab/prefab.json", text(json.dumps({"schema_version": 2, "name": "spherecloud", "version": VERSION, "dependencies": []}))
    yield f"{module}/module.json", text(json.dumps({"export_libraries": [], "android": {}}))
    for header in sorted([*HEADERS.glob("*.h"), *HEADERS.glob("*.hpp")]):
        yield f"{module}/include/spherecloud/{header.name}", header.read_bytes()
    for abi, folder in folders:
        of = {"abi": abi, "api": API, "ndk": 26, "stl": "none", "static": True}
        yield f"{module}/libs/android.{abi}/abi.json", text(json.dumps(of))
        yield f"{module}/libs/android.{abi}/libspherecloud.a", library(abi, folder, "libspherecloud.a")


def aar(classes, folders):
    android = HERE / "android"
    entries = [("AndroidManifest.xml", (android / "AndroidManifest.xml").read_bytes()), ("classes.jar", jar(classes)),
               ("R.txt", b""), ("proguard.txt", (android / "proguard.txt").read_bytes())]
    entries += [(f"jni/{abi}/libspherecloud_jni.so", library(abi, folder, "libspherecloud_jni.so")) for abi, folder in folders]
    return zip_of(entries + list(prefab(folders)))


def main(words):
    if len(words) == 3 and words[0] == "jar":
        made = jar(words[2])
    elif len(words) > 3 and words[0] == "aar" and all("=" in word for word in words[3:]):
        made = aar(words[2], [tuple(word.split("=", 1)) for word in words[3:]])
    else:
        sys.exit(__doc__)
    Path(words[1]).write_bytes(made)


if __name__ == "__main__":
    main(sys.argv[1:])
