#!/usr/bin/env python3
"""Figures of privacy.csv are means over all keys."""
import sys
import unittest

sys.dont_write_bytecode = True
import privacy


def row(metric, value):
    return {"attack": "audit", "map": "room 901", "strategy": "patchwork", "eta": "0.33", "variant": "", "metric": metric, "value": value}


class Means(unittest.TestCase):
    def test_of_all_keys(self):
        (found,) = privacy.means(iter([[row("views", "1")], [row("views", "2")]])).values()
        self.assertEqual(row("views", "1.5"), found)

    def test_a_figure_that_a_key_did_not_give_is_named(self):
        with self.assertRaisesRegex(SystemExit, "room 901 patchwork views is there 1 times under 2 keys"):
            privacy.means([[row("views", "1"), row("other", "1")], [row("other", "2")]])


if __name__ == "__main__":
    unittest.main()
