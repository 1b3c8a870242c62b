#!/usr/bin/env python3
"""growth_rules.py lets additions pass and nothing else."""
import tempfile
import unittest

import growth_rules
from growth_rules import describe_interface
from header_changes import ADDITIONS, BREAKS, declared, grown, headers_with, replaced

# What a compiler for x86-64 does not see.
HIDDEN = {
    "a constant of another value": replaced("SPHC_FORMAT_BGR8 = 3", "SPHC_FORMAT_BGR8 = 99"),
    "a constant is gone": replaced("SPHC_HINT_TOO_FAST = 2u,", ""),
    "more memory than was reserved": replaced("SPHC_MAP_BYTES_MAX 256u", "SPHC_MAP_BYTES_MAX 257u"),
}
UNBINDABLE = {
    "a field of no fixed width": lambda text: grown(text, "sphc_localizer_config", "size_t added"),
    "a struct that grows in another": lambda text: grown(text, "sphc_localizer_frame", "sphc_map_info added"),
    "a struct by value": declared("SPHC_API void sphc_added(sphc_rigid pose);"),
}


def described(change):
    with tempfile.TemporaryDirectory() as folder:
        return describe_interface.describe(headers_with(folder, change))


class Rules(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.today = described(None)

    def test_nothing_is_broken_by_no_change(self):
        self.assertEqual(growth_rules.broken(self.today, self.today), [])

    def test_breaks_are_seen(self):
        for name, change in {**BREAKS, **HIDDEN}.items():
            with self.subTest(name):
                self.assertNotEqual(growth_rules.broken(self.today, described(change)), [])

    def test_a_field_in_what_was_padding_on_one_machine_is_seen(self):
        padded = declared("typedef struct sphc_padded {\n  uint32_t struct_size, a;\n  int64_t time_ns;\n  const void *data;\n"
                          "  uint32_t b, c;\n} sphc_padded;")
        before, now = described(padded), described(lambda text: grown(padded(text), "sphc_padded", "sphc_image added"))
        self.assertEqual([fault.split(":")[0] for fault in growth_rules.broken(before, now)],
                         ["sphc_padded.added lies in what was padding on armv7-linux-gnueabihf"])

    def test_additions_pass(self):
        for name, change in ADDITIONS.items():
            with self.subTest(name):
                now = described(change)
                self.assertEqual(growth_rules.broken(self.today, now) + growth_rules.unbindable(now), [])

    def test_what_no_binding_can_hold_is_seen(self):
        for name, change in UNBINDABLE.items():
            with self.subTest(name):
                self.assertNotEqual(growth_rules.unbindable(described(change)), [])


if __name__ == "__main__":
    unittest.main()
