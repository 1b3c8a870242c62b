#!/usr/bin/env python3
"""nasty.py counts what it should: poses, wrong ones, those of another room; and keeps the rows that it did not measure."""
import contextlib
import io
import pathlib
import sys
import tempfile
import unittest
import unittest.mock

sys.dont_write_bytecode = True
import nasty

VARIANT = ("10", "patchwork", "single")


def frame(world="plain", room=3001, here=True, given=True, centimetres=1.0, degrees=0.5, state="relocalizing", confidence=0.995):
    answer = {"localized": given, "state": state, "confidence": confidence,
              "error": {"translation_m": centimetres / 100, "rotation_deg": degrees},
              "sigma": {"translation_m": 0.01, "rotation_deg": 0.5}}
    return nasty.Frame(world, room, VARIANT, 0, here, answer, [])


class Rows(unittest.TestCase):
    def test_counts(self):
        frames = [frame(), frame(given=False), frame(room=3002, centimetres=26, state="tracking"), frame(room=3002, degrees=11),
                  frame(here=False, given=False), frame(here=False)]
        row = nasty.row_of("plain", VARIANT, frames)
        self.assertEqual((row["rooms"], row["frames"], row["accepted"]), ("2", "4", "3"))
        self.assertEqual((row["wrong_accepted"], row["wrong_tracking"]), ("2", "1"))
        self.assertEqual((row["worst_cm"], row["worst_deg"]), ("26.0", "11.0"))
        self.assertEqual((row["elsewhere_frames"], row["elsewhere_accepted"]), ("2", "1"))
        self.assertEqual((row["within_5cm_5deg_percent_median"], row["within_5cm_5deg_percent_worst"]), ("25.0", "0.0"))
        self.assertEqual(row["sure_right_percent"], "33.33")

    def test_no_pose_at_all(self):
        row = nasty.row_of("plain", VARIANT, [frame(given=False)])
        self.assertEqual((row["accepted"], row["wrong_accepted"], row["ece"], row["worst_cm"]), ("0", "0", "", ""))

    def test_the_row_of_all_sums_rooms_of_each_world_once(self):
        rows = [nasty.row_of("plain", VARIANT, [frame(), frame(room=3002)]), nasty.row_of("plain", VARIANT, [frame()]),
                nasty.row_of("hall", VARIANT, [frame("hall", 4601, centimetres=230.5)])]
        total = nasty.sum_of(rows)
        self.assertEqual((total["rooms"], total["frames"], total["wrong_accepted"], total["worst_cm"]), ("3", "4", "1", "230.5"))

    def test_rows_of_other_worlds_stay(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "nasty.csv"
            nasty.write(path, [nasty.row_of("hall", VARIANT, [frame("hall")]), nasty.row_of("plain", VARIANT, [frame()])])
            self.assertEqual([row["world"] for row in nasty.read(path)], ["plain", "hall"])
            path.write_text("world,frames\nplain,3\n")
            self.assertEqual(nasty.read(path), [], "of another layout")

    def test_a_world_is_given_when_all_its_rooms_are_in(self):
        def room(tool, keep, world, number):
            return [frame(world, nasty.seed_of(world, number))]

        with unittest.mock.patch("nasty.localize_room", room), contextlib.redirect_stderr(io.StringIO()):
            found = list(nasty.measure("", None, ["hall", "plain"], 3, None))
        self.assertEqual([("hall", ["3"]), ("plain", ["3"])], [(world, [row["rooms"] for row in rows]) for world, rows in found])

    def test_no_two_rooms_are_the_same(self):
        seeds = [nasty.seed_of(world, number) + other for world in nasty.WORLDS for number in range(nasty.ROOMS)
                 for other in (0, nasty.ELSEWHERE)]
        self.assertEqual(len(seeds), len(set(seeds)))


if __name__ == "__main__":
    unittest.main()
