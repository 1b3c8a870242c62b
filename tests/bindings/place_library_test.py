#!/usr/bin/env python3
"""The package for Unity takes libraries of the platform that is named, and no others."""
import importlib.util
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parent.parent.parent / "bindings" / "csharp" / "Tools~" / "place_library.py"


def elf(machine):
    return b"\x7fELF" + bytes(14) + bytes([machine, 0])


def archive(*files):
    return b"!<arch>\n" + b"".join(b"%-48s%-10d`\n" % (b"object.o/", len(file)) + file + b"\n" * (len(file) % 2) for file in files)


def dll(machine):
    return b"MZ" + bytes(58) + bytes([64, 0, 0, 0]) + b"PE\0\0" + machine


MACH_O, UNIVERSAL = b"\xcf\xfa\xed\xfe" + bytes(28), b"\xca\xfe\xba\xbe" + bytes(28)
OF_APPLE = archive(b"a table.", b"odd", MACH_O)
TAKEN = {"android-arm64": (elf(183),), "android-arm": (elf(40),), "android-x86_64": (elf(62),), "linux-x86_64": (elf(62),),
         "windows-x86_64": (dll(b"\x64\x86"),), "macos": (MACH_O, UNIVERSAL),
         **dict.fromkeys(("ios", "tvos", "visionos"), (OF_APPLE, UNIVERSAL))}
NEVER_TAKEN = (b"", b"words", elf(243), archive(b"a table.", b"odd", elf(62)), dll(b"\x4c\x01"))


class PlaceLibrary(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        (self.folder / "Tools~").mkdir()
        shutil.copy(SCRIPT, self.folder / "Tools~")

    def place(self, platform, data):
        library = self.folder / "library"
        library.write_bytes(data)
        return subprocess.run([sys.executable, "-B", self.folder / "Tools~" / SCRIPT.name, platform, library], capture_output=True,
                              text=True)

    def test_libraries_of_other_platforms_are_refused(self):
        spec = importlib.util.spec_from_file_location("place_library", SCRIPT)
        script = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(script)
        library = self.folder / "library"
        every = {data for taken in TAKEN.values() for data in taken}.union(NEVER_TAKEN)
        for platform, taken in TAKEN.items():
            with self.assertRaisesRegex(SystemExit, f"there is no file {library}; build the library for {platform}"):
                script.read(platform, library)
            for data in every.difference(taken):
                library.write_bytes(data)
                with self.assertRaisesRegex(SystemExit, f"^place_library.py: .*, and {platform} takes .*; name the library"):
                    script.read(platform, library)
            library.unlink()

    def test_a_library_of_linux_is_none_of_ios(self):
        run = self.place("ios", elf(62))
        self.assertEqual(run.returncode, 1)
        self.assertRegex(run.stderr, "is an ELF file of x86_64, and ios takes an archive of Mach-O objects or a universal file of Apple")
        self.assertFalse((self.folder / "Runtime").exists())

    def test_a_library_of_the_platform_is_placed(self):
        for platform, taken in TAKEN.items():
            for data in taken:
                run = self.place(platform, data)
                self.assertEqual(run.returncode, 0, run.stderr)
                placed = Path(run.stdout.removeprefix("placed ").strip())
                self.assertEqual(placed.read_bytes(), data)
                self.assertIn("PluginImporter", placed.with_name(placed.name + ".meta").read_text())


if __name__ == "__main__":
    unittest.main()
