#!/usr/bin/env python3
"""Are broken sensors believed?  Maps of recordings under several keys, and spherecloud-lab negative on their queries.

    negative.py --spherecloud BIN --lab BIN [--keys N] [--sequences N] [--only FAULT...] [NAME...]

Rewrites negative.csv, for review; with NAME or --only the rows of these recordings or of these faults, and keeps the others.
"""
import argparse
import concurrent.futures
import csv
import itertools
import os
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
from accuracy import REFUSED, Place
from private_key import NUMBERS, numbered_key
from recordings import HERE, frames, run, write_csv

RESULTS = HERE / "negative.csv"
NAMES = ["simulated", "redkitchen", "hololens"]
ETA = 0.33
COUNTS = ["tried", "accepted", "wrong", "wrong_sure", "named", "sequences", "sequences_named"]
COLUMNS = ["recording", "fakes", "mode", "fault", "keys"] + COUNTS + ["worst_m", "worst_deg", "seen"]


def publish(tool, place, folder, fakes, key):
    """A map of the place, with the owner's note beside it."""
    file = folder / "room.sphc"
    run([tool, "build", "--model", place.model, "--map", file, "--eta", ETA, "--fakes", fakes, "--key", numbered_key(key, folder),
         "--ledger", folder / "ledger", "--json"])
    return file


def elsewhere_of(place):
    """Sources of frames that show another place."""
    for name, other in place.refused.items():
        if REFUSED[name]["elsewhere"]:
            yield other.place("query") + (frames(REFUSED[name]["frames"]) if "frames" in REFUSED[name] else [])


def rows_of(arguments, place, file):
    lab, sequences = arguments.lab, arguments.sequences
    only = [word for fault in arguments.only for word in ("--only", fault)]
    for row in run([lab, "negative", *place.recording.source("query"), "--map", file, "--sequences", sequences, *only, "--json"]):
        yield row
    for source in elsewhere_of(place) if not only else ():
        for row in run([lab, "negative", *source, "--map", file, "--sequences", sequences, "--elsewhere", "--json"]):
            yield row | {"fault": "another place"}


def add(sums, key, row):
    known = sums.setdefault(key, dict.fromkeys(COUNTS, 0) | {"worst_m": 0, "worst_deg": 0, "seen": set(), "keys": 0})
    for name in COUNTS:
        known[name] += row[name]
    for name in ("worst_m", "worst_deg"):
        known[name] = max(known[name], row[name] or 0)
    known["seen"] |= set(row["seen"].split())
    known["keys"] += 1


def measure(arguments):
    sums = {}
    for name in arguments.names or NAMES:
        with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            place = Place(name, arguments.spherecloud, pathlib.Path(folder))

            def rows_of_map(made):
                with tempfile.TemporaryDirectory(dir=folder) as own:
                    file = publish(arguments.spherecloud, place, pathlib.Path(own), *made)
                    return list(rows_of(arguments, place, file))

            maps = list(itertools.product(("patchwork", "gaussian"), NUMBERS[:arguments.keys]))
            for (fakes, key), rows in zip(maps, pool.map(rows_of_map, maps)):
                for row in rows:
                    add(sums, (name, fakes, row["mode"], row["fault"]), row)
                print(name, fakes, "key", key, flush=True)
    return sums


def known():
    with RESULTS.open(newline="") as file:
        return list(csv.reader(file))[1:]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spherecloud", required=True)
    parser.add_argument("--lab", required=True)
    parser.add_argument("--keys", type=int, default=len(NUMBERS))
    parser.add_argument("--sequences", type=int, default=2)
    parser.add_argument("--only", nargs="+", metavar="FAULT", default=[])
    parser.add_argument("names", nargs="*", choices=[[], *NAMES], metavar="NAME")
    arguments = parser.parse_args()
    rows = {tuple(row[:4]): row for row in known()} if arguments.names or arguments.only else {}
    for key, row in measure(arguments).items():
        rows[key] = [*key, row["keys"], *(row[name] for name in COUNTS), "%.3f" % row["worst_m"], "%.2f" % row["worst_deg"],
                     " ".join(sorted(row["seen"]))]
    write_csv(RESULTS, [COLUMNS, *rows.values()])


if __name__ == "__main__":
    main()
