#!/usr/bin/env python3
"""Does a walk through eight rooms close?  Simulated flats, each once through all rooms and on into the first ones again.

    mapping_flats.py --spherecloud BIN [--seeds N]      rewrites mapping_flats.csv, for review

The lap of 150 s ends where it began; a tenth more of the walk lies over its beginning.  Few frames a second, so that many
flats can be measured; mapping_growth.py has one at 30 Hz.
"""
import argparse
import concurrent.futures
import os
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
from recordings import HERE, run, write_csv

RESULTS = HERE / "mapping_flats.csv"
SEEDS, RATE_HZ, FRAMES = range(8001, 8013), 4, 660  # rolling.py has the same seeds, of rooms
COLUMNS = ["flat", "frames", "frames_mapped", "parts", "loops", "ate_rigid_m", "worst_m", "revisit_worst_m", "ate_similarity_m", "scale"]


def wanted_rows():
    """What the rows are of: the first column of each."""
    return [(seed,) for seed in SEEDS]


def row_of(seed, tool):
    with tempfile.TemporaryDirectory() as scratch:
        walk = pathlib.Path(scratch) / "walk.mcap"
        run([tool, "simulate", "--out", walk, "--with", "flat", "--seed", seed, "--walk-seed", seed, "--frames", FRAMES, "--rate", RATE_HZ,
             "--threads", 1, "--json"])
        summary = run([tool, "map", "--recording", walk, "--model", pathlib.Path(scratch) / "walk.model", "--threads", 1, "--score", "--json"])
    score = summary["score"]
    row = [seed, FRAMES, summary["frames_mapped"], summary["parts"], summary["loops"], "%.4f" % score["rigid_rmse_m"], "%.4f" % score["rigid_worst_m"],
           "%.4f" % score["revisit_worst_m"] if "revisit_worst_m" in score else "", "%.4f" % score["similarity_rmse_m"], "%.4f" % score["scale"]]
    print(*row, flush=True)
    return row


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spherecloud", required=True)
    parser.add_argument("--results", type=pathlib.Path, default=RESULTS, help="the file to write [mapping_flats.csv]")
    parser.add_argument("--seeds", type=int, default=len(SEEDS), choices=range(1, len(SEEDS) + 1), metavar="N", help="how many flats [12]")
    arguments = parser.parse_args()
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        rows = list(pool.map(lambda seed: row_of(seed, arguments.spherecloud), SEEDS[:arguments.seeds]))
    write_csv(arguments.results, [COLUMNS, *rows])


if __name__ == "__main__":
    main()
