#!/usr/bin/env python3
"""The script of the packages refuses what it cannot install before it makes a Debian, and names the cure."""
import pathlib
import subprocess
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parent / "packages_in_bare_root.sh"


class PackagesInBareRoot(unittest.TestCase):
    def refused(self, words, cause):
        done = subprocess.run([SCRIPT, *words], capture_output=True, text=True, check=False, timeout=60, stdin=subprocess.DEVNULL)
        self.assertEqual((done.returncode, done.stdout), (2, ""), words)
        self.assertIn(cause, done.stderr)

    def test_wants_one_folder(self):
        self.refused([], "there are 0 words")
        self.refused(["build", "other"], "there are 2 words")

    def test_wants_a_built_release(self):
        with tempfile.TemporaryDirectory() as folder:
            self.refused([folder], "build the release there first")
            self.refused([folder + "/missing"], "has no CPackConfig.cmake")


if __name__ == "__main__":
    unittest.main()
