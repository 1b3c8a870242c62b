#!/usr/bin/env python3
"""compare_abi.py tells what breaks programs from what was added.

    compare_abi_test.py CC
"""
import pathlib
import sys
import tempfile
import unittest

import compare_abi
from header_changes import ADDITIONS, BREAKS, headers_with
import write_exports  # of toolchains, whose folder header_changes names

GROWING = compare_abi.growing(compare_abi.SDK / "include")


def exports(include, moved=()):
    """The linker script for such a header; `moved` functions in a node of their own."""
    functions = write_exports.Header(include / "spherecloud" / "spherecloud.h").functions
    nodes = [("SPHERECLOUD_0", functions - set(moved))] + ([("SPHERECLOUD_LATER", set(moved))] if moved else [])
    return write_exports.script(nodes)


def interface(change=None, machine="x86-64", moved=()):
    with tempfile.TemporaryDirectory() as folder:
        include = headers_with(folder, change).parent
        script, library = (pathlib.Path(folder) / name for name in ("exports.map", "library.so"))
        script.write_text(exports(include, moved), encoding="utf-8")
        compare_abi.build(CC, machine, include, script, library)
        return compare_abi.baseline(library)


class Compared(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.today = {machine: interface(machine=machine) for machine in compare_abi.MACHINES}

    def expect(self, wanted, change, machine="x86-64", moved=()):
        verdict, report = compare_abi.compare(self.today[machine], interface(change, machine, moved), GROWING)
        self.assertEqual(verdict, wanted, report)

    def test_breaks_are_seen(self):
        for name, change in BREAKS.items():
            with self.subTest(name):
                self.expect(compare_abi.BREAK, change)

    def test_additions_are_told_and_pass(self):
        for name, change in ADDITIONS.items():
            with self.subTest(name):
                self.expect(compare_abi.ADDITION, change)

    def test_32_bits_are_compared_too(self):
        self.expect(compare_abi.BREAK, BREAKS["a field in the middle"], "i686")
        self.expect(compare_abi.ADDITION, ADDITIONS["a config that grew"], "i686")

    def test_a_function_that_leaves_its_node_is_seen(self):
        self.expect(compare_abi.BREAK, None, moved=("sphc_abi",))

    def test_no_change_is_none_and_a_baseline_is_the_same_each_time(self):
        self.expect(compare_abi.SAME, None, "i686")
        self.assertEqual(self.today["i686"], interface(machine="i686"))

    def test_a_frozen_baseline_takes_additions_alone(self):
        kept, added = self.today["x86-64"], interface(ADDITIONS["a function more"])
        with self.assertRaisesRegex(SystemExit, "libspherecloud.so.1 is frozen"):
            compare_abi.renewed(kept, interface(BREAKS["a field in the middle"]), GROWING)
        self.assertEqual(compare_abi.renewed(kept, added, GROWING), added)


if __name__ == "__main__":
    CC = sys.argv.pop(1)
    unittest.main()
