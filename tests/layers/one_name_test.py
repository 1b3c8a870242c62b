#!/usr/bin/env python3
"""one_name.py finds types of one name, and no others."""
import pathlib
import tempfile
import unittest

import one_name

FILE = "#pragma once\nnamespace sphc::host {\n%s\n}  // namespace sphc::host\n"


class OneName(unittest.TestCase):
    def faults(self, first, second):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for path, text in (("sdk/a/first.h", first), ("drivers/b/second.cpp", second)):
                (root / path).parent.mkdir(parents=True)
                (root / path).write_text(text)
            return list(one_name.faults(root))

    def test_two_types_of_one_name_are_named(self):
        for other in ("struct Place {", "class Place final : public Thing {", "enum class Place : uint32_t { kHere };"):
            found = self.faults(FILE % "struct Place {\n  int x;\n};", FILE % other)
            self.assertEqual(["sphc::host::Place: drivers/b/second.cpp, sdk/a/first.h"], found)

    def test_what_only_says_that_a_type_is_there_counts_not(self):
        for other in ("struct Place;", "using Place = int;", "struct Place placeOf(int x) {", "  struct Place {",
                      "template <>\nstruct Place<int> {"):
            self.assertEqual([], self.faults(FILE % "struct Place {\n};", FILE % other))

    def test_other_namespaces_have_names_of_their_own(self):
        for other in ("namespace sphc {\nstruct Place {\n};\n}  // namespace sphc\n",
                      FILE % "namespace {\n\nstruct Place {\n};\n\n}  // namespace"):
            self.assertEqual([], self.faults(FILE % "struct Place {\n};", other))

    def test_a_namespace_that_ends_gives_the_word_back(self):
        inside = "namespace {\nint x;\n}  // namespace\nstruct Place {\n};"
        self.assertEqual(1, len(self.faults(FILE % "struct Place {\n};", FILE % inside)))


if __name__ == "__main__":
    unittest.main()
