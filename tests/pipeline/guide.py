#!/usr/bin/env python3
"""What does the guide say of walks, and are its loops true?  Real recordings and simulated rooms through `spherecloud guide`.

    guide.py --spherecloud BIN [--rooms N]      rewrites rows of guide.csv, for review

The poses of a recording are used for one thing: how far the two views of a loop lie from where the guide has them.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
from mapping import ROOMS, real_walk, require_walks
from recordings import HERE, Ledger, run

RESULTS = HERE / "guide.csv"
REAL = ["redkitchen", "hololens", "hololens2"]  # walks of mapping.py
FRAMES, RATE = 200, 6.25  # two laps
ADVICE = ["lost", "too dark", "no depth", "too fast", "too plain", "thin"]
FALSE_M, FALSE_DEG = 0.25, 10  # as poses that are wrong, in accuracy.csv
COLUMNS = ["world", "recording", "looks", "followed", "parts", "loops", "confirmed", "false", "worst_m", "worst_deg",
           *(name.replace(" ", "_") for name in ADVICE)]


def lines_of(command):
    result = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=True)
    return [json.loads(line) for line in result.stdout.splitlines()]


def row_of(world, name, tool, source):
    *steps, end = lines_of([tool, "guide", *source, "--json", "--score"])
    summary = end["summary"]
    errors = [step["loop"]["error"] for step in steps if "loop" in step]
    false = [e for e in errors if e["translation_m"] > FALSE_M or e["rotation_deg"] > FALSE_DEG]
    return [world, name, summary["frames"], summary["followed"], summary["parts"], summary["loops"], len(errors), len(false),
            "%.3f" % max([e["translation_m"] for e in errors], default=0), "%.2f" % max([e["rotation_deg"] for e in errors], default=0),
            *(sum(advice in step["advice"].split(", ") for step in steps) for advice in ADVICE)]


def measure_real(name, tool, folder):
    return row_of("real", name, tool, real_walk(name, tool, folder))


def measure_room(seed, tool, folder):
    walk = folder / ("room%d" % seed)
    if not walk.is_dir():
        run([tool, "simulate", "--out", walk, "--seed", seed, "--walk-seed", seed, "--frames", FRAMES, "--rate", RATE, "--json"])
    return row_of("simulated", walk.name, tool, ["--recording", walk])


def wanted_rows():
    """What the rows are of: the first columns of each."""
    return [*(("real", name) for name in REAL), *(("simulated", "room%d" % seed) for seed in ROOMS)]


def ledger_of(path):
    return Ledger(path, COLUMNS, 2)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spherecloud", required=True)
    parser.add_argument("--results", type=pathlib.Path, default=RESULTS, help="the file to write [guide.csv]")
    parser.add_argument("--rooms", type=int, default=len(ROOMS), choices=range(0, len(ROOMS) + 1), metavar="N", help="how many [12]")
    parser.add_argument("--walks", type=pathlib.Path, help="a folder that keeps the simulated walks")
    arguments = parser.parse_args()
    require_walks(REAL)
    ledger = ledger_of(arguments.results)
    with tempfile.TemporaryDirectory() as scratch:
        folder = arguments.walks or pathlib.Path(scratch)
        rows = [measure_real(name, arguments.spherecloud, pathlib.Path(scratch)) for name in REAL]
        rows += [measure_room(seed, arguments.spherecloud, folder) for seed in ROOMS[:arguments.rooms]]
    ledger.put(rows)


if __name__ == "__main__":
    main()
