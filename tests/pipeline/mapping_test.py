#!/usr/bin/env python3
"""The scripts that map walks know each walk that they name."""
import pathlib
import sys
import unittest

sys.dont_write_bytecode = True
import calibration_fit
import guide
import mapping


class Walks(unittest.TestCase):
    def test_every_walk_has_a_recording_and_frames(self):
        for script in (mapping, guide, calibration_fit):
            for name in script.REAL:
                recording, source = mapping.real_walk(name, "spherecloud", pathlib.Path())
                self.assertEqual(recording.place("map") + mapping.frames(mapping.REAL[name][1]), source)
                self.assertEqual(["--recording", "--calibration", "--first", "--last", "--step"], source[::2])

    def test_a_part_of_a_walk_is_of_the_same_recording(self):
        whole, part = (mapping.real_walk(name, "spherecloud", pathlib.Path())[0] for name in ("hololens", "hololens_third"))
        self.assertEqual(whole.folder, part.folder)


if __name__ == "__main__":
    unittest.main()
