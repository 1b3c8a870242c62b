#!/usr/bin/env python3
"""Where the crate tells rustc to look for a library that a Debian package has put into a folder of the system.

    rust_links_test.py CARGO MANIFEST
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

FOLDER = "/usr/lib"  # which pkg-config does not name, as linkers look there anyway
TOLD = f"""libdir={FOLDER}
Name: spherecloud
Description: as if it were installed
Version: 1.0.0
Libs: -L${{libdir}} -lspherecloud
Libs.private: -lhwy -lm
"""


class Links(unittest.TestCase):
    def linked(self, *features):
        """(folders, libraries)"""
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "spherecloud.pc").write_text(TOLD, encoding="utf-8")
            environment = {name: value for name, value in os.environ.items() if name != "SPHERECLOUD_LIB_DIR"}
            done = subprocess.run([CARGO, "check", "--offline", "--locked", "--quiet", "--message-format=json", "--package",
                                   "spherecloud-sys", "--manifest-path", MANIFEST, *features], capture_output=True, text=True,
                                  env={**environment, "PKG_CONFIG_PATH": folder, "CARGO_TARGET_DIR": folder})
        self.assertEqual(done.returncode, 0, done.stderr)
        ran, = (line for line in map(json.loads, done.stdout.splitlines()) if line["reason"] == "build-script-executed")
        return ran["linked_paths"], ran["linked_libs"]

    def test_the_static_library_has_its_folder(self):
        self.assertEqual(self.linked("--features", "static"), ([f"native={FOLDER}"], ["static=spherecloud", "hwy", "m"]))

    def test_the_shared_library_is_found_by_the_linker(self):
        self.assertEqual(self.linked(), ([], ["spherecloud"]))


if __name__ == "__main__":
    CARGO, MANIFEST = sys.argv[1:]
    unittest.main(argv=sys.argv[:1])
