#!/usr/bin/env python3
"""Code and constants of the session's program, for each machine, beside what they may be (size.csv).

    check_size.py VARIANT SIZE-TOOL PROGRAM [--write]     fails above the limit; --write: into the table

Numbers move with every compiler, so limits alone are compared.  The program calls everything but capture; a dynamic C
library is not in it, newlib is.
"""
import csv
import pathlib
import subprocess
import sys

TABLE = pathlib.Path(__file__).resolve().parent / "size.csv"


def read():
    with open(TABLE, encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def write(rows):
    with open(TABLE, "w", encoding="utf-8", newline="") as stream:
        table = csv.DictWriter(stream, list(rows[0]), lineterminator="\n")
        table.writeheader()
        table.writerows(rows)


def main():
    variant, tool, program = sys.argv[1:4]
    told = subprocess.run([tool, program], check=True, capture_output=True, text=True).stdout.splitlines()[1].split()
    rows = read()
    row = next((r for r in rows if r["variant"] == variant), None)
    if row is None:
        sys.exit(f"{TABLE.name} has no limit for {variant}; add a row")
    print(f"{variant}: {told[0]} bytes of code and constants, {row['most_bytes']} are allowed")
    if int(told[0]) > int(row["most_bytes"]):
        sys.exit(1)
    if "--write" in sys.argv:
        row["text_bytes"] = told[0]
        write(rows)


main()
