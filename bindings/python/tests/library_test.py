"""How the library and the command are found, and what is said where they are not."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

PACKAGE = pathlib.Path(__file__).parents[1]


def python(code, **variables):
    kept = {name: value for name, value in os.environ.items() if name != "SPHERECLOUD_LIBRARY"}
    return subprocess.run([sys.executable, "-B", *code], env={**kept, "PYTHONPATH": str(PACKAGE), **variables},
                          capture_output=True, text=True)


class Library(unittest.TestCase):
    def assert_says(self, done, *words):
        self.assertNotEqual(done.returncode, 0)
        for word in words:
            self.assertIn(word, done.stderr)

    def test_missing(self):
        done = python(["-c", "import spherecloud; spherecloud.version()"], SPHERECLOUD_LIBRARY="/nowhere/lib.so")
        self.assert_says(done, "LibraryError", "/nowhere/lib.so", "set SPHERECLOUD_LIBRARY")

    def test_names_of_other_systems(self):
        for system, name in (("win32", "spherecloud.dll"), ("darwin", "libspherecloud.1.dylib"), ("linux", "libspherecloud.so.1")):
            code = f"import sys, ctypes; sys.platform = {system!r}; from spherecloud import _library as l; print(*l.places())"
            self.assertEqual(pathlib.Path(python(["-c", code]).stdout.split()[-1]).name, name)

    def test_another_library(self):
        done = python(["-c", "import spherecloud; spherecloud.load('libm.so.6')"])
        self.assert_says(done, "LibraryError", "libm.so.6 is not the library spherecloud")

    def test_another_abi(self):
        code = "import spherecloud._interface as i; i.SPHC_ABI = 9; import spherecloud; spherecloud.load()"
        self.assert_says(python(["-c", code], SPHERECLOUD_LIBRARY=os.environ["SPHERECLOUD_LIBRARY"]), "LibraryError", "ABI 9", "one release")

    def test_an_explicit_path(self):
        path = os.environ["SPHERECLOUD_LIBRARY"]
        done = python(["-c", f"import spherecloud as s; s.load({path!r}); print(s.version()); s.load('other')"])
        self.assertTrue(done.stdout.strip(), done.stderr)
        self.assert_says(done, "was loaded from", "E_STATE")

    def test_command(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assert_says(python(["-m", "spherecloud", "--help"], PATH=folder), "neither in this package nor in PATH")
            command = pathlib.Path(folder) / "spherecloud"
            command.write_text("#!/bin/sh\necho \"it has $*\"\nexit 3\n")
            command.chmod(0o755)
            done = python(["-m", "spherecloud", "report", "a b"], PATH=f"{folder}:/bin:/usr/bin")
            self.assertEqual((done.returncode, done.stdout), (3, "it has report a b\n"))


if __name__ == "__main__":
    unittest.main()
