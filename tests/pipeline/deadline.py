#!/usr/bin/env python3
"""Do frames end by their deadlines, and how many poses are left?  Maps of recordings, and spherecloud-lab deadline on their
queries, on white noise, and on maps whose points all lie in one cell.

    deadline.py --spherecloud BIN --lab BIN [--frames N] [--case C] [NAME...]      rewrites rows of deadline.csv, for review
"""
import argparse
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
from accuracy import Place
from negative import publish
from recordings import HERE, Ledger, run

RESULTS = HERE / "deadline.csv"
NAMES = ["redkitchen", "hololens", "simulated"]
COUNTS = ["features_cut", "matches_cut", "search_cut", "verification_cut"]
COLUMNS = ["recording", "case", "deadline_us", "frames", "in_time_percent", "median_us", "worst_us", "right", "right_percent_of_free",
           "wrong"] + COUNTS
# Options of the bench, and how many frames a row has, of those asked for.
CASES = {
    "single": (["--half"], 1),
    "tracking": (["--half", "--tracking"], 2),
    "noise": (["--noise"], 2),
    "one cell": (["--one-cell", "--deadline-us", 3000, "--deadline-us", 20000], 4),
    "one cell, exact, 4096 keypoints": (["--one-cell", "--probes", 0, "--max-keypoints", 4096, "--deadline-us", 3000,
                                         "--deadline-us", 20000], 4),
}


def rows_of(lab, place, file, options, frames):
    source = [lab, "deadline", *place.recording.source("query"), "--map", file, "--json"]
    once = run([*source, "--deadline-us", 100])[0]["frames"]  # how many a pass has
    measured = run([*source, *options, "--repeat", max(1, frames // once)])
    free = measured[0]["right"]
    for row in measured:
        share = "%.1f" % (100 * row["right"] / free) if free else ""
        yield row | {"in_time_percent": "%.2f" % (100 * row["in_time"] / row["frames"]), "right_percent_of_free": share}


def ledger_of(path):
    return Ledger(path, COLUMNS, 2, lambda row: (NAMES.index(row[0]), list(CASES).index(row[1])))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spherecloud", required=True)
    parser.add_argument("--lab", required=True)
    parser.add_argument("--frames", type=int, default=360, help="of a row, about; whole passes of the recording")
    parser.add_argument("--case", choices=CASES, action="append", help="these alone")
    parser.add_argument("names", nargs="*", choices=[[], *NAMES], metavar="NAME")
    arguments = parser.parse_args()
    ledger = ledger_of(RESULTS)
    for name in arguments.names or NAMES:
        with tempfile.TemporaryDirectory() as folder:
            place = Place(name, arguments.spherecloud, pathlib.Path(folder))
            file = publish(arguments.spherecloud, place, pathlib.Path(folder), "patchwork", 0)
            for case in arguments.case or CASES:
                options, part = CASES[case]
                rows = rows_of(arguments.lab, place, file, options, arguments.frames // part)
                ledger.put([name, case] + [row[column] for column in COLUMNS[2:]] for row in rows)
                print(name, case, flush=True)


if __name__ == "__main__":
    main()
