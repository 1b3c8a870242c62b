#!/usr/bin/env python3
"""Compares what a program prints with its results.

    check_results.py exact PROGRAM RESULTS [--write]   every line the same
    check_results.py stack PROGRAM RESULTS [--write]   last column: at most the results file's, and not under half of it

Frames on the stack differ between compilers and instruction sets, so the results file of the stack is a ceiling, in whole
KiB and a quarter above what was measured.
"""
import subprocess
import sys


def stack_ceilings(rows):
    return [rows[0]] + [[name, str((int(size) * 5 // 4 // 1024 + 1) * 1024)] for name, size in rows[1:]]


def read_rows(text):
    return [line.rsplit(",", 1) for line in text.splitlines()]


def faults(mode, pinned, now):
    if mode == "exact":
        old, new = dict(pinned), dict(now)
        return [f"{key}: results {old.get(key)}, now {new.get(key)}" for key in {**old, **new} if old.get(key) != new.get(key)]
    found = []
    for (name, ceiling), (now_name, size) in zip(pinned[1:], now[1:]):
        if name != now_name or not int(ceiling) // 2 - 1024 <= int(size) <= int(ceiling):
            found.append(f"{now_name}: {size} bytes of stack, results {name} {ceiling}")
    return found + (["rows differ"] if len(pinned) != len(now) else [])


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    mode, program, results = sys.argv[1:4]
    output = subprocess.run([program], check=True, capture_output=True, text=True).stdout
    print(output, end="")
    rows = read_rows(output)
    if "--write" in sys.argv:
        rows = rows if mode == "exact" else stack_ceilings(rows)
        with open(results, "w", encoding="utf-8") as stream:
            stream.write("".join(",".join(row) + "\n" for row in rows))
        return
    with open(results, encoding="utf-8") as stream:
        found = faults(mode, read_rows(stream.read()), rows)
    if found:
        sys.exit("\n".join(found) + f"\nthe results file {results} differs; if that is meant, build the target memory_results")


if __name__ == "__main__":
    main()
