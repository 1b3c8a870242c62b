#!/usr/bin/env python3
"""What tests/run.sh counts: no failure is lost."""
import contextlib
import io
import unittest

import count_cases

BRIEF = "[==========] %d tests from 1 test suite ran. (1 ms total)\n"


def entry(status, output="", skipped=None):
    reason = '<skipped message="%s"/>' % skipped if skipped else ""
    return '<testcase name="x" status="%s">%s<system-out>%s</system-out></testcase>' % (status, reason, output)


def count(*entries):
    with contextlib.redirect_stderr(io.StringIO()):
        return count_cases.count(io.StringIO("<testsuite>%s</testsuite>" % "".join(entries)))


class CountCases(unittest.TestCase):
    def test_entries_count_as_one(self):
        self.assertEqual((1, 1, 1), count(entry("run"), entry("fail"), entry("notrun", skipped="SKIP_RETURN_CODE=77")))

    def test_what_cannot_be_run_failed(self):
        self.assertEqual((0, 2, 0), count(entry("notrun", skipped="Unable to find executable"),
                                          entry("notrun", skipped="Fixture dependency failed")))

    def test_a_program_counts_as_its_cases(self):
        self.assertEqual((12, 0, 0), count(entry("run", BRIEF % 12 + "[  PASSED  ] 12 tests.\n")))
        self.assertEqual((11, 1, 0), count(entry("fail", BRIEF % 12 + "[  PASSED  ] 11 tests.\n"
                                                 "[  FAILED  ] 1 test, listed below:\n[  FAILED  ] A.B\n")))
        self.assertEqual((1, 0, 1), count(entry("run", BRIEF % 2 + "[  PASSED  ] 1 test.\n"
                                                "[  SKIPPED ] 1 test, listed below:\n[  SKIPPED ] A.B\n")))

    def test_a_program_that_crashes_leaks_or_runs_nothing_failed(self):
        self.assertEqual((0, 1, 0), count(entry("fail", "[==========] Running 3 tests\nSegmentation fault")))
        self.assertEqual((3, 1, 0), count(entry("fail", BRIEF % 3 + "[  PASSED  ] 3 tests.\nLeakSanitizer")))
        self.assertEqual((0, 1, 0), count(entry("run", BRIEF % 0 + "[  PASSED  ] 0 tests.\n")))

    def test_no_entry_is_a_failure(self):
        self.assertEqual((0, 1, 0), count())


if __name__ == "__main__":
    unittest.main()
