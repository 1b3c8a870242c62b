#!/usr/bin/env python3
"""What do hostile frames and maps cost?  Maps of recordings, and spherecloud-lab worst on their queries.

    worst.py --spherecloud BIN --lab BIN [--frames N] [NAME...]      rewrites worst.csv, for review
"""
import argparse
import csv
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
from accuracy import Place
from negative import publish
from recordings import HERE, run

RESULTS = HERE / "worst.csv"
NAMES = ["redkitchen", "hololens", "simulated"]
FIGURES = ["frames", "times_normal_median", "times_normal_worst", "times_deadline_worst", "localized", "wrong",
           "keypoints", "matches", "iterations", "stack_bytes", "state_bytes", "scratch_bytes"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spherecloud", required=True)
    parser.add_argument("--lab", required=True)
    parser.add_argument("--frames", type=int, default=12, help="of a case")
    parser.add_argument("names", nargs="*", choices=[[], *NAMES], metavar="NAME")
    arguments = parser.parse_args()
    table = []
    for name in arguments.names or NAMES:
        with tempfile.TemporaryDirectory() as folder:
            place = Place(name, arguments.spherecloud, pathlib.Path(folder))
            file = publish(arguments.spherecloud, place, pathlib.Path(folder), "patchwork", 0)
            source = [arguments.lab, "worst", *place.recording.source("query"), "--map", file]
            for row in run([*source, "--frames", arguments.frames, "--json"]):
                table.append([name, row["case"]] + [row[column] for column in FIGURES])
                print(name, row["case"], row["times_normal_median"], flush=True)
        with RESULTS.open("w", newline="") as out:  # after each recording, so that the next one can be given up
            writer = csv.writer(out, lineterminator="\n")
            writer.writerow(["recording", "case"] + FIGURES)
            writer.writerows(table)


if __name__ == "__main__":
    main()
