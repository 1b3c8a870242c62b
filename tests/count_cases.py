#!/usr/bin/env python3
"""count_cases.py JUNIT.xml - prints how many test cases of a run of ctest passed, failed and were skipped.

An entry that is a GoogleTest program counts as the cases that it reports, any other as one.  A program that reports no
case, or ends badly although its cases passed, is a failure.  What was skipped is named on standard error.
"""
import re
import sys
import xml.etree.ElementTree

REPORTED = re.compile(r"^\[ +(PASSED|FAILED|SKIPPED) +\] (\d+) tests?[.,]", re.MULTILINE)
SKIPPED_CASE = re.compile(r"^\[ +SKIPPED +\] ([^\s,]+\.[^\s,]+)$", re.MULTILINE)
MEANT = ("SKIP_RETURN_CODE", "SKIP_REGULAR_EXPRESSION", "Disabled")


def program_cases(status, output):
    found = dict.fromkeys(("PASSED", "FAILED", "SKIPPED"), 0)
    for name, number in REPORTED.findall(output):
        found[name] += int(number)
    if not sum(found.values()) or status != "run" and not found["FAILED"]:
        found["FAILED"] += 1
    return found["PASSED"], found["FAILED"], found["SKIPPED"]


def cases(entry):
    """(passed, failed, skipped) of one entry."""
    status, output = entry.get("status"), entry.findtext("system-out") or ""
    if "[==========]" in output:
        for name in sorted(set(SKIPPED_CASE.findall(output))):
            print("skipped:", name, file=sys.stderr)
        return program_cases(status, output)
    if status == "run":
        return 1, 0, 0
    reason = entry.find("skipped")
    if status != "fail" and reason is not None and reason.get("message", "").startswith(MEANT):
        print("skipped: %s: %s" % (entry.get("name"), output.strip()), file=sys.stderr)
        return 0, 0, 1
    return 0, 1, 0  # failed, or could not be run


def count(file):
    entries = [cases(entry) for entry in xml.etree.ElementTree.parse(file).getroot().iter("testcase")]
    return tuple(map(sum, zip(*entries))) if entries else (0, 1, 0)


if __name__ == "__main__":
    print(*count(sys.argv[1]))
