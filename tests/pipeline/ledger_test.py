#!/usr/bin/env python3
"""A ledger of which a part is measured anew keeps the rest, and every committed one is as its script would leave it."""
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
import calibration_fit
import deadline
import guide
import hints
import mapping
import mapping_localized
import mapping_peers
import worst
from recordings import Ledger

COLUMNS = ["recording", "case", "value"]


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

    def test_committed_ledgers_are_as_their_scripts_leave_them(self):
        for script in (calibration_fit, deadline, guide, hints, mapping, mapping_localized, mapping_peers, worst):
            committed = script.RESULTS.read_text()
            self.path.write_text(committed)
            script.ledger_of(self.path).put([])
            self.assertEqual(committed, self.path.read_text(), script.__name__)


if __name__ == "__main__":
    unittest.main()
