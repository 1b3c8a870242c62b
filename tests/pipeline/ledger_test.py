#!/usr/bin/env python3
"""A ledger of which a part is measured anew keeps the rest, and every committed one is as its script would leave it, with all its rows."""
import collections
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
import amplitude
import calibration_fit
import cameras
import deadline
import frame
import guide
import hints
import mapping
import mapping_flats
import mapping_growth
import mapping_localized
import mapping_peers
import maps
import nasty
import rolling
import worst
from recordings import HERE, Ledger, ran, read_rows, run, write_rows

COLUMNS = ["recording", "case", "value"]
# Scripts that state their rows, and the columns that say what a row is of; accuracy.py has a test of its own.
STATED = {amplitude: ["world", "amplitude_min"], calibration_fit: ["given", "recording", "calibration"], cameras: cameras.KEY,
          frame: ["recording", "points", "variant"], guide: ["world", "recording"], mapping: ["world", "recording", "poses"],
          mapping_flats: ["flat"], mapping_growth: ["world", "frames"], mapping_localized: ["recording", "truth", "poses"],
          mapping_peers: ["recording", "mapper"], maps: ["maps"], rolling: rolling.KEY}
OF_ACCURACY = {"accuracy.csv", "accuracy_keys.csv", "confidence.csv"}
# How many rows the other ledgers have of each name in their first column, or in all.  Whoever measures more or fewer changes it here.
ROOMS_AT_30_HZ = dict.fromkeys(["feet", "people", "doubles", "mirror", "dark", "telephone", "hall", "evening", "bathroom", "menu"], 12)
OF_ONE_COMMAND = {
    8: ["version"], 15: ["guide", "live"], 16: ["doctor", "key", "key encryption"], 20: ["inspect", "advise", "simulate"],
    19: ["build", "build model", "map", "map refine", "convert", "convert raw", "record", "record guide", "calibration", "sign", "encrypt", "decrypt"],
    21: ["build first", "audit"], 22: ["localize"], 23: ["convert folder", "convert 7scenes"]}
OF_ONE_FILE = ["%s_eta%d_dev" % (name, eta) for name in ("apt1_kitchen_hybrid", "redkitchen01_sfm") for eta in (25, 33, 50, 100)]
COUNTED = {
    "align.csv": {"640x480": 3, "320x288": 3},
    "compare.csv": {"redkitchen01_sfm": 18, "apt1_kitchen_hybrid": 9},
    "coverage.csv": {"device": 17, "parsers": 8},
    "deadline.csv": dict.fromkeys(deadline.NAMES, 23),
    "descriptors.csv": {"redkitchen": 12, "hololens": 12},
    "faults.csv": {name: count for count, names in OF_ONE_COMMAND.items() for name in names},
    "features.csv": {"redkitchen/seq-01": 8, "hololens": 8},
    "fuzz.csv": {"address undefined": 35, "none": 31},
    "hints.csv": {"rooms": 24, "redkitchen": 20, "hololens": 18, "hololens_blocks": 18},
    "late_depth.csv": {"a lap": 18, "2 s": 2, "2 s, depth older by 17 ms": 2, "2 s, depth older by 17 ms, not told": 2},
    "match.csv": {"10000": 20, "50000": 20, "200000": 20, "1000000": 14},
    "nasty.csv": {"all": 1, **dict.fromkeys(nasty.WORLDS, 4), **ROOMS_AT_30_HZ, "plain": 6, "flat": 6},
    "negative.csv": {"simulated": 176, "redkitchen": 176, "hololens": 172},
    "parallel.csv": {"redkitchen": 2, "hololens": 2},
    "pose.csv": dict.fromkeys(OF_ONE_FILE, 18),
    "pose_growth.csv": dict(zip(OF_ONE_FILE, (24, 24, 16, 16))),
    "privacy.csv": {"inversion": 72, "density": 27, "intersection": 28, "triangulation": 38, "leaks": 26, "presence": 2, "querying client": 24,
                    "audit": 784, "real_or_fake": 808},
    "recording.csv": {"redkitchen": 6, "hololens": 6},
    "rig.csv": {"walk": 6, "wall": 6},
    "soak.csv": 18,
    "worst.csv": {"redkitchen": 16, "simulated": 16},
}


def faults_of_stated(rows, columns, wanted):
    """Of a ledger: which rows are missing, and which twice or needless."""
    there = collections.Counter(tuple(row[column] for column in columns) for row in rows)
    wanted = collections.Counter(tuple(map(str, row)) for row in wanted)
    yield from ("%s is missing" % (row,) for row in wanted - there)
    yield from ("%s is twice or needless" % (row,) for row in there - wanted)


def faults_of_counted(rows, wanted):
    """Of a ledger: where it has more or fewer rows."""
    there = collections.Counter(next(iter(row.values())) for row in rows)
    there, wanted = (there, wanted) if isinstance(wanted, dict) else ({"in all": len(rows)}, {"in all": wanted})
    yield from ("%s: %d rows, not %d" % (name, there.get(name, 0), wanted.get(name, 0)) for name in sorted(there.keys() | wanted.keys())
                if there.get(name, 0) != wanted.get(name, 0))


class Ledgers(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name) / "ledger.csv"

    def lines(self):
        return self.path.read_text().split()

    def test_rows_of_others_stay(self):
        self.path.write_text("recording,case,value\na,x,1\na,x,2\nb,x,3\n")
        Ledger(self.path, COLUMNS, 2).put([["a", "x", 4], ["c", "y", 5]])
        self.assertEqual(["recording,case,value", "a,x,4", "b,x,3", "c,y,5"], self.lines())

    def test_what_is_put_later_is_put_beside_it(self):
        ledger = Ledger(self.path, COLUMNS, 1, lambda row: "ab".index(row[0]))
        ledger.put([["b", "x", 1]])
        ledger.put(iter([["a", "x", 2], ["a", "y", 3]]))
        self.assertEqual(["recording,case,value", "a,x,2", "a,y,3", "b,x,1"], self.lines())
        self.assertEqual([self.path], list(self.path.parent.iterdir()))

    def test_another_layout_is_refused(self):
        self.path.write_text("recording,value\na,1\n")
        with self.assertRaises(SystemExit):
            Ledger(self.path, COLUMNS, 2)
        self.assertEqual(["recording,value", "a,1"], self.lines())

    def test_a_ledger_is_written_whole_or_not_at_all(self):
        write_rows(self.path, COLUMNS, [{"value": 1, "recording": "a", "case": "x", "other": 2}])
        with self.assertRaises(KeyError):
            write_rows(self.path, COLUMNS, iter([{"recording": "b", "case": "x", "value": 2}, {"recording": "b"}]))
        self.assertEqual(["recording,case,value", "a,x,1"], self.lines())

    def test_a_command_ends_the_script_unless_its_status_is_accepted(self):
        ends = [sys.executable, "-c", "print('[4]'); raise SystemExit(3)"]
        self.assertEqual(("[4]\n", [4]), (ran(ends, accepted=(0, 3)).stdout, run(ends)))
        with self.assertRaisesRegex(SystemExit, "ended with 3: .*\n\\[4\\]"):
            ran(ends)

    def test_committed_ledgers_are_as_their_scripts_leave_them(self):
        for script in (calibration_fit, deadline, guide, hints, mapping, mapping_localized, mapping_peers, worst):
            committed = script.RESULTS.read_text()
            self.path.write_text(committed)
            script.ledger_of(self.path).put([])
            self.assertEqual(committed, self.path.read_text(), script.__name__)

    def test_every_ledger_has_the_rows_that_its_script_states(self):
        for script, columns in STATED.items():
            self.assertEqual([], list(faults_of_stated(read_rows(script.RESULTS), columns, script.wanted_rows())), script.__name__)

    def test_every_other_ledger_has_as_many_rows_as_are_counted(self):
        for name, counts in COUNTED.items():
            self.assertEqual([], list(faults_of_counted(read_rows(HERE / name), counts)), name)

    def test_no_ledger_is_left_out(self):
        held = [*(script.RESULTS.name for script in STATED), *COUNTED, *OF_ACCURACY]
        self.assertEqual(sorted(path.name for path in HERE.glob("*.csv")), sorted(held))

    def test_a_lost_row_is_seen(self):
        rows = read_rows(cameras.RESULTS)
        self.assertEqual(["('headset', 'headset', 'tracking') is missing"],
                         list(faults_of_stated(rows[:1] + rows[2:], cameras.KEY, cameras.wanted_rows())))
        self.assertEqual(["('headset', 'headset', 'single') is twice or needless"],
                         list(faults_of_stated(rows[:1] + rows, cameras.KEY, cameras.wanted_rows())))
        self.assertEqual(["headset: 7 rows, not 8"], list(faults_of_counted(rows[1:9], {"headset": 8, "phone": 1})))
        self.assertEqual(["in all: 31 rows, not 32"], list(faults_of_counted(rows[1:], 32)))


if __name__ == "__main__":
    unittest.main()
