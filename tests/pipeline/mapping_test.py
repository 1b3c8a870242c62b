#!/usr/bin/env python3
"""The scripts that map walks know each walk that they name, and write nothing where one is absent."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
import calibration_fit
import guide
import mapping
import recordings


class Walks(unittest.TestCase):
    def test_every_walk_has_a_recording_and_frames(self):
        for script in (mapping, guide, calibration_fit):
            for name in script.REAL:
                source = mapping.real_walk(name, "spherecloud", pathlib.Path())
                self.assertEqual(["--recording", "--calibration", "--first", "--last", "--step"], source[::2])

    def test_a_part_of_a_walk_is_of_the_same_recording(self):
        whole, part = (mapping.real_walk(name, "spherecloud", pathlib.Path()) for name in ("hololens", "hololens_third"))
        self.assertEqual(whole[:4], part[:4])

    def test_without_a_recording_nothing_is_written(self):
        with tempfile.TemporaryDirectory() as folder:
            for script in ("mapping", "guide", "calibration_fit", "mapping_localized", "mapping_peers"):
                results = pathlib.Path(folder) / (script + ".csv")
                results.write_text("as it was")
                for is_required, status in (("0", recordings.SKIPPED), ("1", 1)):
                    done = subprocess.run([sys.executable, recordings.HERE / (script + ".py"), "--spherecloud=/nonexistent", "--results", results],
                                          capture_output=True, env={**os.environ, "SPHC_DATA": folder, "SPHC_REQUIRE_DATA": is_required})
                    self.assertEqual(status, done.returncode, done.stderr)
                    self.assertEqual("as it was", results.read_text())


if __name__ == "__main__":
    unittest.main()
