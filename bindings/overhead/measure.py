#!/usr/bin/env python3
"""What a binding costs beside C: its row of bindings/overhead.csv, measured anew.

    measure.py LANGUAGE C_PROGRAM FOLDER PACKAGE... -- COMMAND...

C_PROGRAM is overhead.c, and COMMAND the program that does the same in LANGUAGE.  Each plays the golden session of FOLDER
whenever it is told to, and prints the processor time of its thread.  Both play by turns, and the ratio is taken of two
sessions side by side, which meet the same noise.  The ratio of a repeat is the median of its rounds; that of the row is the
median of the repeats, with its lower and upper quartile.  PACKAGE: what a program ships, the library too; code is counted
without symbols.
"""
import csv
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

LEDGER = Path(__file__).resolve().parent.parent / "overhead.csv"
COLUMNS = ("language", "c_us", "binding_us", "ratio", "ratio_low", "ratio_high", "call_ns", "package_bytes")
REPEATS, ROUNDS, WARM_UP = 16, 24, 20


def start(command):
    return subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1)


def play(program):
    program.stdin.write("go\n")
    return [int(number) for number in program.stdout.readline().split()]


def repeat(programs):
    """(ratio, of C in us, of the binding in us, ns that a prediction takes longer): the medians of one repeat, in which each
    program is the first as often."""
    rounds = []
    for index in range(ROUNDS):
        order = (0, 1) if index % 2 else (1, 0)
        played = {which: play(programs[which]) for which in order}
        c_us, binding_us = (statistics.mean(played[which][:-1]) / 1e3 for which in (0, 1))
        rounds.append((binding_us / c_us, c_us, binding_us, played[1][-1] - played[0][-1]))
    return [statistics.median(column) for column in zip(*rounds)]


def bytes_of(package):
    """Of a file; of machine code without its symbols."""
    if not package.read_bytes().startswith(b"\x7fELF"):
        return package.stat().st_size
    with tempfile.NamedTemporaryFile() as stripped:
        subprocess.run(["strip", "-o", stripped.name, package], check=True)
        return Path(stripped.name).stat().st_size


def measured(language, programs, packages):
    for _ in range(WARM_UP):
        for program in programs:
            play(program)
    ratios, c_us, binding_us, call_ns = zip(*(repeat(programs) for _ in range(REPEATS)))
    low, middle, high = statistics.quantiles(ratios, method="inclusive")
    values = (language, *(f"{statistics.median(of):.0f}" for of in (c_us, binding_us)), *(f"{ratio:.4f}" for ratio in (middle, low, high)),
              f"{statistics.median(call_ns):.0f}", sum(map(bytes_of, packages)))
    return dict(zip(COLUMNS, map(str, values)))


def write(row):
    with open(LEDGER, encoding="utf-8", newline="") as stream:
        rows = {old["language"]: old for old in csv.DictReader(stream)}
    rows[row["language"]] = row
    with open(LEDGER, "w", encoding="utf-8", newline="") as stream:
        ledger = csv.DictWriter(stream, COLUMNS, lineterminator="\n")
        ledger.writeheader()
        ledger.writerows(rows[name] for name in sorted(rows))


def main(words):
    if "--" not in words[3:]:
        sys.exit(__doc__)
    language, c_program, folder, *packages = words[:words.index("--")]
    programs = [start(command) for command in ([c_program, folder], [*words[words.index("--") + 1:], folder])]
    row = measured(language, programs, list(map(Path, packages)))
    for program in programs:
        program.stdin.close()
        program.wait()
    write(row)
    print(", ".join(f"{name} {value}" for name, value in row.items()))


if __name__ == "__main__":
    main(sys.argv[1:])
