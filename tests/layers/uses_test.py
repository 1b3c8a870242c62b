#!/usr/bin/env python3
"""uses.py finds a name whose header is not included, and no other."""
import pathlib
import tempfile
import unittest

import uses

TABLE = "sdk/base | |\nsdk/a | sdk/base |\nsdk/b | |\n"
HEADER = "#pragma once\nnamespace sphc {\n%s\n}  // namespace sphc\n"
SOURCE = '%s\nnamespace sphc {\nvoid use() {\n  %s\n}\n}  // namespace sphc\n'


class Uses(unittest.TestCase):
    def faults(self, declared, used, includes="", own="sdk/a/own.cpp", more=()):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            files = {"table": TABLE, "sdk/base/names.h": HEADER % declared, own: SOURCE % (includes, used), **dict(more)}
            for path, text in files.items():
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).write_text(text)
            return uses.Tree(root, root / "table").faults()

    def test_types_constants_and_functions_are_asked(self):
        for declared, used in (("struct Place {\n};", "Place place;"), ("enum class Place { kHere };", "auto x = Place::kHere;"),
                               ("using Place = int;", "return Place(3);"), ("constexpr double kFarM = 3;", "return kFarM;"),
                               ("double median(std::vector<double> values);", "const double m = median(v);"),
                               ("class Failure {};", "throw Failure(1);"), ("int place(int x);", "return sphc::place(1);")):
            found = self.faults(declared, used)
            self.assertEqual(1, len(found), (declared, used))
            self.assertRegex(found[0], r"^sdk/a/own.cpp:4: \w+ is declared in sdk/base/names.h, which is not included$")
            self.assertEqual([], self.faults(declared, used, '#include "base/names.h"'))

    def test_an_include_of_an_include_is_enough(self):
        own = ("sdk/a/own.h", '#pragma once\n#include "base/names.h"\n')
        self.assertEqual([], self.faults("struct Place {\n};", "Place place;", '#include "a/own.h"', more=[own]))

    def test_names_of_the_file_itself_are_its_own(self):
        for used in ("const double median = 3;", "auto median = [](int x) { return x; };", "other.median(3);", "std::median(3);",
                     "// median(3)", 'say("median(3)");', "int (*f)(int) = 0, median = 3;"):
            self.assertEqual([], self.faults("int median(int x);", used), used)

    def test_members_of_other_types_are_not_meant(self):
        self.assertEqual([], self.faults("struct Place {\n  int median(int x);\n};", "return median(3);"))

    def test_a_header_that_may_not_be_included_is_not_meant(self):
        self.assertEqual([], self.faults("struct Place {\n};", "Place place;", own="sdk/b/own.cpp"))

    def test_a_namespace_that_is_not_seen_is_not_meant(self):
        other = ("sdk/base/other.h", "namespace sphc::other {\nstruct Far {\n};\n}  // namespace sphc::other\n")
        self.assertEqual([], self.faults("struct Place {\n};", "Far far;", more=[other]))


if __name__ == "__main__":
    unittest.main()
