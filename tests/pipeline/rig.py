#!/usr/bin/env python3
"""What further cameras bring: frames of a rig of four grey cameras and a wide ToF camera, by one camera, two, three and all; and by
all with a narrow ToF camera ahead, and with another to the left of it, which says 1 cm too much.

    rig.py --spherecloud BIN --lab BIN [--results FILE] [--rooms N] [--keep FOLDER]      rewrites rig.csv, for review

Every simulated room has bare walls and a map of lap one, of the headset with one camera, under a key of its own.  Views of lap two
are localized each alone: as the walk looks, and with nothing but a wall ahead; all have as many keypoints in all.
"""
import argparse
import concurrent.futures
import os
import pathlib
import statistics
import sys
import tempfile

sys.dont_write_bytecode = True
from private_key import key_of
from recordings import HERE, run, write_rows

RESULTS = HERE / "rig.csv"
ROOMS = list(range(5001, 5013))  # seeds of room and walk, which amplitude.py and the flat of nasty.py have too; and of key
LAP_S, MAP_FRAMES, VIEWS = 16, 100, 25
ETA, FAKES = 0.33, "patchwork"
COLUMNS = ["view", "cameras", "tof", "frames", "localized_percent", "within_5cm_5deg_percent", "worst_room_percent", "wrong_accepted",
           "median_mm", "p95_mm", "features_ms_median", "frame_ms_median"]


def rows_of(tool, lab, folder, seed):
    walk, file = folder / ("walk_%d" % seed), folder / ("%d.sphc" % seed)
    if not file.exists():
        run([tool, "simulate", "--out", walk, "--seed", seed, "--walk-seed", seed, "--with", "bare", "--frames", MAP_FRAMES, "--rate",
             MAP_FRAMES / LAP_S, "--threads", 1, "--json"])
        key = key_of("rig key %d" % seed, folder / ("%d.key" % seed))
        run([tool, "build", "--recording", walk, "--map", file, "--eta", ETA, "--fakes", FAKES, "--key", key, "--ledger",
             str(file) + ".ledger", "--json"])
    return run([lab, "rig", "--seed", seed, "--map", file, "--views", VIEWS, "--threads", 1, "--json"])


def percent(part, whole):
    return "%.1f" % (100 * part / max(1, whole))


def row_of(view, cameras, tof, rooms):
    """rooms: the same row of each."""
    whole = lambda name: sum(row[name] for row in rooms)
    every = lambda name: sorted(value for row in rooms for value in row[name])
    errors = every("errors_mm") or [0]
    return dict(zip(COLUMNS, [
        view, cameras, tof, whole("frames"), percent(whole("localized"), whole("frames")), percent(whole("right"), whole("frames")),
        min((percent(row["right"], row["frames"]) for row in rooms if row["frames"]), key=float), whole("wrong"),
        "%.1f" % statistics.median(errors), "%.1f" % errors[int(0.95 * (len(errors) - 1))],
        *("%.2f" % (statistics.median(every(name)) / 1000) for name in ("features_us", "frame_us"))]))


def measure(tool, lab, folder, count):
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        rooms = list(pool.map(lambda seed: rows_of(tool, lab, folder, seed), ROOMS[:count]))
    for rows in zip(*rooms):
        yield row_of(rows[0]["view"], rows[0]["cameras"], rows[0]["tof"], rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spherecloud", required=True, help="the command")
    parser.add_argument("--lab", required=True, help="spherecloud-lab")
    parser.add_argument("--results", type=pathlib.Path, default=RESULTS, help="the file to write [rig.csv]")
    parser.add_argument("--rooms", type=int, default=len(ROOMS), metavar="N", help="the first N rooms")
    parser.add_argument("--keep", type=pathlib.Path, metavar="FOLDER", help="where recordings and maps are kept")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = arguments.keep or pathlib.Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        rows = list(measure(arguments.spherecloud, arguments.lab, folder, arguments.rooms))
    write_rows(arguments.results, COLUMNS, rows)


if __name__ == "__main__":
    main()
