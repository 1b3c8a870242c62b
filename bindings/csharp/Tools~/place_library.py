#!/usr/bin/env python3
"""Puts a native library where Unity finds it, with the settings of its platform beside it.

    place_library.py PLATFORM LIBRARY      such as: place_library.py android-arm64 build/android/lib/libspherecloud.so

iOS, tvOS and visionOS want the static library, libspherecloud.a; all others want the shared one.  What is placed is not for git: a package
that is handed on as a folder or a .tgz has it inside.
"""
import hashlib
import pathlib
import sys

MACHINES = {3: "x86", 40: "ARM", 62: "x86_64", 183: "ARM64"}  # as ELF numbers them
ARCHIVE, MACH_O, UNIVERSAL = "an archive of Mach-O objects", "a Mach-O library", "a universal file of Apple"
# What a platform takes: of Apple the system is not looked at.
KINDS = {
    "android-arm64": ("an ELF file of ARM64",),
    "android-arm": ("an ELF file of ARM",),
    "android-x86_64": ("an ELF file of x86_64",),
    "ios": (ARCHIVE, UNIVERSAL),
    "tvos": (ARCHIVE, UNIVERSAL),
    "visionos": (ARCHIVE, UNIVERSAL),
    "linux-x86_64": ("an ELF file of x86_64",),
    "windows-x86_64": ("a DLL of x86_64",),
    "macos": (MACH_O, UNIVERSAL),
}
PLUGINS = pathlib.Path(__file__).resolve().parent.parent / "Runtime" / "Plugins"
# Folder and name of the file; Unity's name of the platform; processor; the editor's system, where it runs there.
PLATFORMS = {
    "android-arm64": ("Android/arm64-v8a/libspherecloud.so", "Android: Android", "ARM64", None),
    "android-arm": ("Android/armeabi-v7a/libspherecloud.so", "Android: Android", "ARMv7", None),
    "android-x86_64": ("Android/x86_64/libspherecloud.so", "Android: Android", "X86_64", None),
    "ios": ("iOS/libspherecloud.a", "iPhone: iOS", "AnyCPU", None),
    "tvos": ("tvOS/libspherecloud.a", "tvOS: tvOS", "AnyCPU", None),
    "visionos": ("VisionOS/libspherecloud.a", "VisionOS: VisionOS", "AnyCPU", None),
    "linux-x86_64": ("Linux/x86_64/libspherecloud.so", "Standalone: Linux64", "x86_64", "Linux"),
    "windows-x86_64": ("Windows/x86_64/spherecloud.dll", "Standalone: Win64", "x86_64", "Windows"),
    "macos": ("macOS/libspherecloud.dylib", "Standalone: OSXUniversal", "AnyCPU", "OSX"),
}


def archived(data):
    """The first bytes of each file in an archive."""
    at = 8
    while data[at + 58:at + 60] == b"`\n":
        size = int(data[at + 48:at + 58])
        yield data[at + 60:at + 64]
        at += 60 + size + size % 2


def kind(data):
    """What a file is, by its header."""
    if data[:4] == b"\x7fELF":
        return "an ELF file of " + MACHINES.get(int.from_bytes(data[18:20], "little"), "another processor")
    if data[:8] == b"!<arch>\n":
        return "an archive of ELF objects" if b"\x7fELF" in archived(data) else ARCHIVE
    if data[:2] == b"MZ":
        header = int.from_bytes(data[60:64], "little")
        return "a DLL of " + ("x86_64" if data[header:header + 6] == b"PE\0\0\x64\x86" else "another processor")
    return {b"\xcf\xfa\xed\xfe": MACH_O, b"\xca\xfe\xba\xbe": UNIVERSAL}.get(data[:4], "no library")


def read(platform, library):
    """Its bytes, if it is of this platform."""
    if not library.is_file():
        sys.exit(f"place_library.py: there is no file {library}; build the library for {platform} and name it")
    data = library.read_bytes()
    if kind(data) not in KINDS[platform]:
        sys.exit(f"place_library.py: {library} is {kind(data)}, and {platform} takes {' or '.join(KINDS[platform])}; name the "
                 f"library that was built for {platform}")
    return data


def entry(platform, enabled, **settings):
    lines = [f"  - first:\n      {platform}\n    second:\n      enabled: {enabled}\n      settings:" + ("" if settings else " {}")]
    return "\n".join(lines + [f"        {name}: {value}" for name, value in settings.items()]) + "\n"


def head(path):
    guid = hashlib.md5(f"SphereCloud SDK: {path.relative_to(PLUGINS.parent.parent)}".encode()).hexdigest()
    return f"fileFormatVersion: 2\nguid: {guid}\n"


END = "  userData: \n  assetBundleName: \n  assetBundleVariant: \n"


def importer(name):
    _, platform, cpu, editor = PLATFORMS[name]
    start = ("PluginImporter:\n  externalObjects: {}\n  serializedVersion: 2\n"
            "  isPreloaded: 0\n  isOverridable: 0\n  isExplicitlyReferenced: 0\n  validateReferences: 1\n  platformData:\n")
    here = {"CPU": "x86_64" if editor in ("Linux", "Windows") else "AnyCPU", "OS": editor} if editor else {}
    return (start + entry("Any: ", 0) + entry("Editor: Editor", int(bool(editor)), DefaultValueInitialized="true", **here)
            + entry(platform, 1, CPU=cpu))


def write_meta(path, settings):
    path.with_name(path.name + ".meta").write_text(head(path) + settings + END, encoding="utf-8")


def main():
    if len(sys.argv) != 3 or sys.argv[1] not in PLATFORMS:
        sys.exit(__doc__ + "\nPLATFORM: " + ", ".join(PLATFORMS))
    data = read(sys.argv[1], pathlib.Path(sys.argv[2]))
    file = PLUGINS / PLATFORMS[sys.argv[1]][0]
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_bytes(data)
    write_meta(file, importer(sys.argv[1]))
    for folder in file.relative_to(PLUGINS).parents[:-1]:
        write_meta(PLUGINS / folder, "folderAsset: yes\nDefaultImporter:\n  externalObjects: {}\n")
    print(f"placed {file}")


if __name__ == "__main__":
    main()
