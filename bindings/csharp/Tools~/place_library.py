#!/usr/bin/env python3
"""Puts a native library where Unity finds it, with the settings of its platform beside it.

    place_library.py PLATFORM LIBRARY      such as: place_library.py android-arm64 build/android/lib/libspherecloud.so

iOS wants the static library, libspherecloud.a; all others want the shared one.  What is placed is not for git: a package
that is handed on as a folder or a .tgz has it inside.
"""
import hashlib
import pathlib
import shutil
import sys

PLUGINS = pathlib.Path(__file__).resolve().parent.parent / "Runtime" / "Plugins"
# Folder and name of the file; Unity's name of the platform; processor; the editor's system, where it runs there.
PLATFORMS = {
    "android-arm64": ("Android/arm64-v8a/libspherecloud.so", "Android: Android", "ARM64", None),
    "android-arm": ("Android/armeabi-v7a/libspherecloud.so", "Android: Android", "ARMv7", None),
    "android-x86_64": ("Android/x86_64/libspherecloud.so", "Android: Android", "X86_64", None),
    "ios": ("iOS/libspherecloud.a", "iPhone: iOS", "AnyCPU", None),
    "linux-x86_64": ("Linux/x86_64/libspherecloud.so", "Standalone: Linux64", "x86_64", "Linux"),
    "windows-x86_64": ("Windows/x86_64/spherecloud.dll", "Standalone: Win64", "x86_64", "Windows"),
    "macos": ("macOS/libspherecloud.dylib", "Standalone: OSXUniversal", "AnyCPU", "OSX"),
}


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
    file = PLUGINS / PLATFORMS[sys.argv[1]][0]
    file.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(sys.argv[2], file)
    write_meta(file, importer(sys.argv[1]))
    for folder in file.relative_to(PLUGINS).parents[:-1]:
        write_meta(PLUGINS / folder, "folderAsset: yes\nDefaultImporter:\n  externalObjects: {}\n")
    print(f"placed {file}")


if __name__ == "__main__":
    main()
