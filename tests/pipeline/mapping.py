#!/usr/bin/env python3
"""How well are walks mapped?  Real recordings and simulated rooms through `spherecloud map --score`.

    mapping.py --spherecloud BIN [--rooms N] [--poses KIND ...]      rewrites rows of mapping.csv, for review

The poses of a recording are compared with those that were found.  KIND is what the mapper is told: none, or those poses
disturbed as disturbed_poses.py says.  Rows of other kinds and rooms stay as they are.
"""
import argparse
import concurrent.futures
import os
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
import disturbed_poses
from recordings import HERE, Ledger, Recording, frames, require, run

RESULTS = HERE / "mapping.csv"
ROOMS = list(range(6001, 6013))  # seeds of room and walk; guide.py, calibration_fit.py and the other scripts of mapping have them too
FRAMES, LAP_S = 100, 16  # one lap
# Recording and frames of each: what maps are made of elsewhere, all of the walk, and a third of it, which is a walk of quick turns.
REAL = {"redkitchen": ("redkitchen", (0, 597, 3)), "hololens": ("hololens", (0, 199, 1)), "hololens2": ("hololens2", (0, 999, 1)),
        "hololens_third": ("hololens", (0, 199, 3)), "hololens2_third": ("hololens2", (0, 999, 3))}
KINDS = ["none", "approximate", "odometry"]
COLUMNS = ["world", "recording", "poses", "frames", "frames_mapped", "parts", "ate_rigid_m", "ate_unaligned_m", "ate_similarity_m", "scale", "rotation_median_deg",
           "rotation_worst_deg", "processor_s"]


def told(kind, recording, name, folder):
    """Options that tell the mapper the disturbed poses."""
    if kind == "none":
        return []
    file = folder / ("%s_%s.tum" % (name, kind))
    disturbed_poses.write(kind, recording, file)
    return ["--poses", kind, "--poses-from", file]


def row_of(world, name, kind, tool, source, folder):
    recording = pathlib.Path(source[source.index("--recording") + 1])
    summary = run([tool, "map", *source, *told(kind, recording, name, folder), "--model", folder / ("%s_%s.model" % (name, kind)),
                   "--score", "--json"])
    score = summary["score"]
    unaligned = "%.4f" % score["unaligned_rmse_m"] if "unaligned_rmse_m" in score else ""
    return [world, name, kind, summary["frames"], summary["frames_mapped"], summary["parts"], "%.4f" % score["rigid_rmse_m"], unaligned,
            "%.4f" % score["similarity_rmse_m"], "%.4f" % score["scale"], "%.2f" % score["rotation_median_deg"],
            "%.2f" % score["rotation_worst_deg"], "%.0f" % summary["processor_seconds"]]


def real_walk(name, tool, folder):
    """How the command line is told of a walk of REAL."""
    of, selection = REAL[name]
    return Recording(of, tool, folder).place("map") + frames(selection)


def require_walks(names):
    require(REAL[name][0] for name in names)


def measure_real(name, kinds, tool, folder):
    source = real_walk(name, tool, folder)
    return [row_of("real", name, kind, tool, source, folder) for kind in kinds]


def measure_room(seed, kinds, tool, folder):
    walk = folder / ("room%d" % seed)
    run([tool, "simulate", "--out", walk, "--seed", seed, "--walk-seed", seed, "--frames", FRAMES, "--rate", FRAMES / LAP_S,
         "--threads", 1, "--json"])
    return [row_of("simulated", walk.name, kind, tool, ["--recording", walk], folder) for kind in kinds]


def wanted_rows():
    """What the rows are of: the first columns of each."""
    walks = [*(("real", name) for name in REAL), *(("simulated", "room%d" % seed) for seed in ROOMS)]
    return [(*walk, kind) for kind in KINDS for walk in walks]


def ledger_of(path):
    return Ledger(path, COLUMNS, 3, lambda row: (row[0], KINDS.index(row[2])))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spherecloud", required=True)
    parser.add_argument("--results", type=pathlib.Path, default=RESULTS, help="the file to write [mapping.csv]")
    parser.add_argument("--rooms", type=int, default=len(ROOMS), choices=range(0, len(ROOMS) + 1), metavar="N", help="how many [12]")
    parser.add_argument("--poses", nargs="+", default=KINDS, choices=KINDS, metavar="KIND", help="what the mapper is told [all]")
    arguments = parser.parse_args()
    require_walks(REAL)
    ledger = ledger_of(arguments.results)
    with tempfile.TemporaryDirectory() as scratch, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        folder = pathlib.Path(scratch)
        jobs = [pool.submit(measure_real, name, arguments.poses, arguments.spherecloud, folder) for name in REAL]
        jobs += [pool.submit(measure_room, seed, arguments.poses, arguments.spherecloud, folder) for seed in ROOMS[:arguments.rooms]]
        ledger.put([row for job in jobs for row in job.result()])


if __name__ == "__main__":
    main()
