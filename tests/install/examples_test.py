#!/usr/bin/env python3
"""The examples refuse wrong arguments and files with a cause, and overwrite none of what they were given.

    examples_test.py EXAMPLES SPHERECLOUD     the folder of the built examples, and the command
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

MAP = pathlib.Path(__file__).resolve().parents[1] / "portability" / "room.sphc"
NO_MAP = "is empty, or no file; give the map that the builder wrote"


class Examples(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory(prefix="of examples ")))
        for words in ("simulate --frames 2 --out walk", "convert walk walk.raw --to raw"):
            subprocess.run([COMMAND, *words.split()], cwd=cls.folder, check=True, capture_output=True)
        shutil.copy(MAP, cls.folder / "room.sphc")
        (cls.folder / "empty").touch()

    def refused(self, status, cause, example, *words):
        done = subprocess.run([EXAMPLES / example, *words], cwd=self.folder, capture_output=True, text=True, check=False, timeout=60,
                              stdin=subprocess.DEVNULL)
        self.assertIn(cause, done.stderr)
        self.assertEqual((done.returncode, done.stdout), (status, ""))

    def test_a_map_is_a_file_with_content(self):
        for what in ("empty", "walk"):
            self.refused(1, NO_MAP, "minimal_c", what, "walk")
            self.refused(1, NO_MAP, "live_c", "color", "depth", "walk/calibration.json", what)
        for what in ("empty", "walk", "missing"):
            self.refused(1, f"{what}: ", "minimal_cpp", what, "walk")

    def test_wrong_words(self):
        for words in (["few"], ["color", "depth", "calibration", "map", "many"], ["color", "depth", "calibration", "map", "0"]):
            self.refused(2, "usage: ", "live_c", *words)
        for words in (["--help"], ["/dev/video0"], ["/dev/video0", "colour"], ["/dev/video0", "color", "640"],
                      ["/dev/video0", "color", "640", "480", "30", "many"]):
            self.refused(2, "usage: ", "v4l2_probe", *words)

    def test_what_is_read_is_not_overwritten(self):
        before = {name: (self.folder / name).read_bytes() for name in ("room.sphc", "walk.raw")}
        self.refused(1, "plays the sensor", "sensor_c", "room.sphc", "walk.raw", "./walk.raw")
        self.refused(1, "is the map", "sensor_c", "room.sphc", "walk.raw", "./room.sphc")
        for name, content in before.items():
            self.assertEqual((self.folder / name).read_bytes(), content, name)


if __name__ == "__main__":
    EXAMPLES, COMMAND = (pathlib.Path(word).resolve() for word in sys.argv[1:])
    unittest.main(argv=sys.argv[:1])
