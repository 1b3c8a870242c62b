#!/usr/bin/env python3
"""Audits maps of recordings and of simulated rooms, and writes the figures into privacy.csv.

    privacy.py --spherecloud BIN [--rooms FOLDER]

Real recordings are looked for in $SPHC_DATA, else in ../shared/data beside the repository.  Simulated rooms 901 to 906,
which no attacker has trained on, are made in FOLDER unless they are there.  The views of all places are put together for
the rows of map "all".
"""
import argparse
import collections
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile

from private_key import private_key

HERE = pathlib.Path(__file__).resolve().parent
DATA = pathlib.Path(os.environ.get("SPHC_DATA", HERE.parent.parent.parent / "shared" / "data"))
RESULTS = HERE / "privacy.csv"
ROOMS = range(901, 907)
STRATEGIES = ("gaussian", "patchwork")


def run(command, accepted=(0,)):
    result = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if result.returncode not in accepted:
        sys.exit("failed: %s\n%s%s" % (" ".join(map(str, command)), result.stdout, result.stderr))
    return json.loads(result.stdout)


def places(tool, rooms):
    calibration = HERE / "calibration"
    yield "redkitchen", ["--recording", DATA / "redkitchen/seq-01", "--calibration", calibration / "redkitchen.json",
                         "--last", 597, "--step", 3]
    yield "hololens", ["--recording", DATA / "hololens", "--calibration", calibration / "hololens.json"]
    for seed in ROOMS:
        room = rooms / str(seed)
        if not room.exists():
            run([tool, "simulate", "--out", room, "--seed", seed, "--walk-seed", seed, "--json"])
        yield "room %d" % seed, ["--recording", room]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spherecloud", required=True)
    parser.add_argument("--rooms", type=pathlib.Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        pooled = collections.defaultdict(lambda: [0, 0, 0])  # strategy, points: views, coarse hits, fine hits
        for name, recording in places(options.spherecloud, options.rooms or folder):
            for strategy in STRATEGIES:
                stem = folder / ("%s_%s" % (name.replace(" ", ""), strategy))
                truth = stem.with_suffix(".ledger")
                run([options.spherecloud, "build", *recording, "--map", stem.with_suffix(".sphc"), "--ledger", truth,
                     "--key", private_key(folder), "--fakes", strategy, "--json"])
                found = run([options.spherecloud, "audit", stem.with_suffix(".sphc"), "--truth", truth, *recording,
                             "--figures", RESULTS, "--name", name, "--json"], accepted=(0, 4))
                print(name, strategy, {f["name"]: round(f["value"], 3) for f in found["figures"] if "value" in f},
                      flush=True)
                for row in found["inversions"]:
                    sums = pooled[strategy, row["points"]]
                    sums[0] += row["views"]
                    sums[1] += row["views"] * row["retrieval_coarse"]
                    sums[2] += row["views"] * row["retrieval_fine"]
    with RESULTS.open(newline="") as results:
        rows = [row for row in csv.reader(results) if row[:2] != ["audit", "all"]]
    for (strategy, points), (views, coarse, fine) in pooled.items():
        for metric, hits in (("coarse", coarse), ("fine", fine)):
            share = hits / views
            error = (share * (1 - share) / views) ** 0.5
            rows.append(["audit", "all", strategy, "0.33", points, "retrieval_" + metric, "%.4g" % share])
            rows.append(["audit", "all", strategy, "0.33", points, "retrieval_%s_standard_error" % metric, "%.2g" % error])
    with RESULTS.open("w", newline="") as results:
        csv.writer(results, lineterminator="\n").writerows(rows)


if __name__ == "__main__":
    main()
