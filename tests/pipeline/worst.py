#!/usr/bin/env python3
"""What do hostile frames and maps cost?  Maps of recordings, and spherecloud-lab worst on their queries.

    worst.py --spherecloud BIN --lab BIN [--frames N] [NAME...]      rewrites rows of worst.csv, for review
"""
import argparse
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
from accuracy import Place
from negative import publish
from recordings import HERE, Ledger, run

RESULTS = HERE / "worst.csv"
NAMES = ["redkitchen", "hololens", "simulated"]
FIGURES = ["frames", "times_normal_median", "times_normal_worst", "times_deadline_worst", "localized", "wrong",
           "keypoints", "matches", "iterations", "stack_bytes", "state_bytes", "scratch_bytes"]


def ledger_of(path):
    return Ledger(path, ["recording", "case"] + FIGURES, 1, lambda row: NAMES.index(row[0]))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spherecloud", required=True)
    parser.add_argument("--lab", required=True)
    parser.add_argument("--frames", type=int, default=12, help="of a case")
    parser.add_argument("names", nargs="*", choices=[[], *NAMES], metavar="NAME")
    arguments = parser.parse_args()
    ledger = ledger_of(RESULTS)
    for name in arguments.names or NAMES:
        with tempfile.TemporaryDirectory() as folder:
            place = Place(name, arguments.spherecloud, pathlib.Path(folder))
            file = publish(arguments.spherecloud, place, pathlib.Path(folder), "patchwork", 0)
            source = [arguments.lab, "worst", *place.recording.source("query"), "--map", file]
            rows = run([*source, "--frames", arguments.frames, "--json"])
        for row in rows:
            print(name, row["case"], row["times_normal_median"], flush=True)
        ledger.put([name, row["case"]] + [row[column] for column in FIGURES] for row in rows)  # so that the next one can be given up


if __name__ == "__main__":
    main()
