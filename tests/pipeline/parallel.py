#!/usr/bin/env python3
"""How much sooner is a cold frame answered by several cores?  Maps of 50 000 points of both real recordings, and
spherecloud-lab parallel on their queries.

    parallel.py --lab BIN [--repeat N] [--threads N...]      rewrites parallel.csv, for review
"""
import argparse
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
from frame import RUNS, maps
from recordings import HERE, Recording, frames, run, write_csv

RESULTS = HERE / "parallel.csv"
NAMES = ["redkitchen", "hololens"]
RATIOS = ["times_faster", "features_times_faster", "match_times_faster"]
COLUMNS = ["recording", "threads", "frames", "same_bytes", *RATIOS, "scratch_bytes"]


def rows_of(arguments, name):
    with tempfile.TemporaryDirectory() as folder:
        recording = Recording(name, arguments.lab, pathlib.Path(folder))
        threads = [option for count in arguments.threads for option in ("--threads", count)]
        yield from run([arguments.lab, "parallel", *recording.place("query"), *frames(RUNS[name]["query"]),
                        *maps(arguments.lab, RUNS[name], pathlib.Path(folder)), *threads, "--repeat", arguments.repeat, "--json"])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lab", required=True, help="the command spherecloud-lab")
    parser.add_argument("--repeat", type=int, default=15, help="runs of a frame of which the median time counts")
    parser.add_argument("--threads", type=int, nargs="+", default=[2])
    arguments = parser.parse_args()
    table = []
    for name in NAMES:
        for row in rows_of(arguments, name):
            row |= {"recording": name} | {ratio: "%.2f" % row[ratio] for ratio in RATIOS}
            table.append([row[column] for column in COLUMNS])
            print(*table[-1], flush=True)
    write_csv(RESULTS, [COLUMNS, *table])


if __name__ == "__main__":
    main()
