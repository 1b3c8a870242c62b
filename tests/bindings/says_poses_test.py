#!/usr/bin/env python3
"""The check of an example's words sees a pose that is missing, and an example that does not end well."""
import sys
import unittest

sys.dont_write_bytecode = True
from says_poses import fault_of

GOOD = ["%d: FEW" % frame if frame == 6 else "%d: at 1.5" % frame for frame in range(10)]


def fault(lines, status=0):
    return fault_of(status, "".join(line + "\n" for line in lines), r"at 1[.]5", r"at [0-9.]+", "FEW")


class SaysPoses(unittest.TestCase):
    def test_what_is_as_wanted(self):
        self.assertIsNone(fault(GOOD))
        self.assertIsNone(fault(["frame " + line for line in GOOD]))

    def test_what_is_not(self):
        self.assertEqual("exit status -11", fault(GOOD, -11))
        self.assertEqual("1 lines instead of 10", fault(GOOD[:1]))
        self.assertEqual("not as wanted: 0: at 2", fault(["0: at 2", *GOOD[1:]]))
        self.assertEqual("not as wanted: 1: FEW", fault([GOOD[0], "1: FEW", *GOOD[2:]]))
        self.assertEqual("not as wanted: 6: at 2", fault([*GOOD[:6], "6: at 2", *GOOD[7:]]))
        self.assertEqual("not as wanted: 1: at 1.5", fault([GOOD[1], GOOD[0], *GOOD[2:]]))


if __name__ == "__main__":
    unittest.main()
