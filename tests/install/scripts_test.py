#!/usr/bin/env python3
"""The first scripts that a user runs say what they take, do nothing otherwise, and are told in full where a build follows."""
import pathlib
import re
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Scripts(unittest.TestCase):
    def said(self, status, script, *words):
        done = subprocess.run([ROOT / script, *words], capture_output=True, text=True, check=False, timeout=60, stdin=subprocess.DEVNULL)
        self.assertEqual((done.returncode, done.stdout if status else done.stderr), (status, ""), words)
        return done.stdout + done.stderr

    def test_quickstart(self):
        self.assertIn("run it again at will", self.said(0, "examples/quickstart.sh", "--help"))
        self.assertIn('takes no arguments, and there is "fast"', self.said(2, "examples/quickstart.sh", "fast"))

    def test_sections_of_packages(self):
        self.assertIn("sections: runtime build ", self.said(2, "toolchains/install_packages.sh"))
        self.assertIn('there is no section "runtim"; sections: runtime build ',
                      self.said(2, "toolchains/install_packages.sh", "build", "runtim"))

    def test_pages_install_compilers_too(self):
        for page in (*ROOT.glob("docs/*.md"), ROOT / "README.md"):
            for sections in re.findall(r"^ *toolchains/install_packages\.sh ([\w ]+)", page.read_text(encoding="utf-8"), re.MULTILINE):
                if "build" in sections.split():
                    self.assertIn("runtime", sections.split(), page)


if __name__ == "__main__":
    unittest.main()
