#!/usr/bin/env python3
"""Holds the byte ledger against the committed one: ledger_test.py PRINTER [--update]

Sizes must be the same to the byte; the stack, which compilers lay out as they like, must not grow.
"""
import csv
import pathlib
import subprocess
import sys

LEDGER = pathlib.Path(__file__).with_name("bytes.csv")
MOST_STACK = 64 * 1024


def rows(text):
    return {(r["configuration"], r["memory"], r["piece"]): int(r["bytes"]) for r in csv.DictReader(text.splitlines())}


def main():
    printed = subprocess.run([sys.argv[1]], check=True, capture_output=True, text=True).stdout
    if "--update" in sys.argv:
        LEDGER.write_text(printed)
        return
    committed, now = rows(LEDGER.read_text()), rows(printed)
    faults = ["%s: not in both" % (key,) for key in sorted(committed.keys() ^ now.keys())]
    for key in sorted(committed.keys() & now.keys()):
        if key[1] == "stack":
            if now[key] > min(MOST_STACK, 2 * committed[key]):
                faults.append("%s: %d, ledger %d" % (key, now[key], committed[key]))
        elif committed[key] != now[key]:
            faults.append("%s: %d, ledger %d" % (key, now[key], committed[key]))
    sys.exit("\n".join(faults + ["if meant: ninja update_bytes, and review the diff"]) if faults else 0)


main()
