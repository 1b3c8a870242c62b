#!/usr/bin/env python3
"""mirror.py finds sources without a test, lines that are not needed, and tests that are not compiled."""
import pathlib
import tempfile
import unittest

import mirror


class Mirror(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for source in ("sdk/a/mirrored.cpp", "sdk/a/included.cpp", "sdk/a/alone.cpp", "drivers/d/alone.c"):
            self.write(source, "")
        self.write("tests/unit/a/mirrored_test.cpp", '#include "a/included.h"\n')
        self.write("tests/unit/CMakeLists.txt", "sphc_test(a SOURCES a/mirrored_test.cpp)\n")

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def faults(self, listed):
        self.write("mirror.txt", listed)
        return list(mirror.faults(self.root, self.root / "mirror.txt"))

    def test_a_source_without_a_test_is_named(self):
        found = self.faults("")
        self.assertEqual(["drivers/d/alone.c", "sdk/a/alone.cpp"], [fault.split(":")[0] for fault in found])

    def test_instruction_sets_share_a_test(self):
        for source in ("sdk/a/mirrored_simd.cpp", "sdk/a/mirrored_scalar.cpp", "sdk/a/alone_simd.cpp"):
            self.write(source, "")
        self.assertIn("sdk/a/alone_simd.cpp", "".join(self.faults("")))
        self.assertNotIn("mirrored", "".join(self.faults("")))

    def test_the_c_interface_is_tested_by_itself(self):
        self.write("sdk/runtime/capi/b.cpp", "")
        self.write("sdk/a/b.cpp", "")
        self.write("tests/capi/b_test.cpp", "")
        self.write("tests/capi/CMakeLists.txt", "sphc_test(b SOURCES b_test.cpp)\n")
        self.assertEqual(["sdk/a/b.cpp"], [f.split(":")[0] for f in self.faults("sdk/a/alone.cpp: unit/a\ndrivers/d: unit/a\n")])

    def test_a_line_names_its_test(self):
        test = "unit/a/mirrored_test.cpp"
        self.assertEqual([], self.faults("# words\nsdk/a/alone.cpp: %s\ndrivers/d: %s # more\n" % (test, test)))

    def test_a_line_without_a_test_or_a_source_is_a_fault(self):
        good = "sdk/a/alone.cpp: unit/a\ndrivers/d: unit/a\n"
        for line in ("drivers/d/alone.c: unit/a/no_test.cpp", "sdk/a/mirrored.cpp: unit/a", "sdk/gone.cpp: unit/a"):
            self.assertTrue(self.faults(good + line + "\n"), line)

    def test_a_test_that_is_not_compiled_is_named(self):
        listed = "sdk/a/alone.cpp: unit/a\ndrivers/d: unit/a\n"
        self.write("tests/unit/b/mirrored_test.cpp", "")
        self.write("tests/unit/b/further_test.cpp", "")
        self.write("tests/unit/CMakeLists.txt", "sphc_test(a SOURCES a/mirrored_test.cpp b/further_test.cpp)\n")
        self.assertEqual(["tests/unit/b/mirrored_test.cpp"], [fault.split(":")[0] for fault in self.faults(listed)])


if __name__ == "__main__":
    unittest.main()
