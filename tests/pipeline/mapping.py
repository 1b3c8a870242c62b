#!/usr/bin/env python3
"""How well are walks mapped without poses?  Real recordings and simulated rooms through `spherecloud map --score`.

    mapping.py --spherecloud BIN [--rooms N]      rewrites mapping.csv, for review

The poses of a recording are compared with those that were found, and used for nothing else.
"""
import argparse
import concurrent.futures
import csv
import os
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
from recordings import HERE, Recording, frames, run

RESULTS = HERE / "mapping.csv"
ROOMS = list(range(6001, 6013))  # seeds of room and walk that nothing else uses
FRAMES, LAP_S = 100, 16  # one lap
# Frames of each: what maps are made of elsewhere, and all of the walk.
REAL = {"redkitchen": (0, 597, 3), "hololens": (0, 199, 1), "hololens2": (0, 999, 1)}
COLUMNS = ["world", "recording", "frames", "frames_mapped", "parts", "ate_rigid_m", "ate_similarity_m", "scale", "rotation_median_deg",
           "rotation_worst_deg", "processor_s"]


def row_of(world, name, tool, source, folder):
    summary = run([tool, "map", *source, "--model", folder / (name + ".model"), "--score", "--json"])
    score = summary["score"]
    return [world, name, summary["frames"], summary["frames_mapped"], summary["parts"], "%.4f" % score["rigid_rmse_m"],
            "%.4f" % score["similarity_rmse_m"], "%.4f" % score["scale"], "%.2f" % score["rotation_median_deg"],
            "%.2f" % score["rotation_worst_deg"], "%.0f" % summary["processor_seconds"]]


def measure_real(name, tool, folder):
    recording = Recording(name, tool, folder)
    return row_of("real", name, tool, recording.place("map") + frames(REAL[name]), folder) if recording.is_there() else None


def measure_room(seed, tool, folder):
    walk = folder / ("room%d" % seed)
    run([tool, "simulate", "--out", walk, "--seed", seed, "--walk-seed", seed, "--frames", FRAMES, "--rate", FRAMES / LAP_S,
         "--threads", 1, "--json"])
    return row_of("simulated", walk.name, tool, ["--recording", walk], folder)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spherecloud", required=True)
    parser.add_argument("--results", type=pathlib.Path, default=RESULTS, help="the file to write [mapping.csv]")
    parser.add_argument("--rooms", type=int, default=len(ROOMS), choices=range(0, len(ROOMS) + 1), metavar="N", help="how many [12]")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        folder = pathlib.Path(scratch)
        jobs = [pool.submit(measure_real, name, arguments.spherecloud, folder) for name in REAL]
        jobs += [pool.submit(measure_room, seed, arguments.spherecloud, folder) for seed in ROOMS[:arguments.rooms]]
        rows = [job.result() for job in jobs]
    with arguments.results.open("w", newline="") as out:
        csv.writer(out, lineterminator="\n").writerows([COLUMNS, *(row for row in rows if row)])


if __name__ == "__main__":
    main()
