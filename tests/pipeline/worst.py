#!/usr/bin/env python3
"""What do hostile frames and maps cost?  Maps of recordings, and spherecloud-lab worst on their queries; instructions by callgrind.

    worst.py --spherecloud BIN --lab BIN [--frames N] [NAME...]      rewrites worst.csv, for review
"""
import argparse
import csv
import pathlib
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
from accuracy import Place
from negative import publish
from recordings import HERE, run

RESULTS = HERE / "worst.csv"
NAMES = ["redkitchen", "hololens", "simulated"]
FIGURES = ["frames", "times_normal_median", "times_normal_worst", "times_normal_instructions", "times_deadline_worst", "localized", "wrong",
           "keypoints", "matches", "iterations", "stack_bytes", "state_bytes", "scratch_bytes"]


def instructions_of(source, case):
    """Of one frame; none where valgrind is missing."""
    try:
        done = subprocess.run(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", "--toggle-collect=sphc_localizer_process",
                               *map(str, source), "--frames", "1", "--once", case], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                              text=True, check=True)
    except FileNotFoundError:
        return 0
    return int(re.search(r"Collected : (\d+)", done.stderr)[1])


def rows_of(lab, place, file, frames):
    source = [lab, "worst", *place.recording.source("query"), "--map", file]
    normal = 0
    for row in run([*source, "--frames", frames, "--json"]):
        instructions = instructions_of(source, row["case"])
        normal = normal or instructions
        yield row | {"times_normal_instructions": f"{instructions / normal:.2f}" if normal else ""}


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
            for row in rows_of(arguments.lab, place, file, arguments.frames):
                table.append([name, row["case"]] + [row[column] for column in FIGURES])
                print(name, row["case"], row["times_normal_median"], row["times_normal_instructions"], flush=True)
    with RESULTS.open("w", newline="") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(["recording", "case"] + FIGURES)
        writer.writerows(table)


if __name__ == "__main__":
    main()
