#!/usr/bin/env python3
"""How well does `spherecloud map --refine-calibration` mend a calibration that is off?

    calibration_fit.py --spherecloud BIN [--rooms N]      rewrites rows of calibration_fit.csv, for review

Walks through simulated rooms are mapped with a calibration that is spoiled at random: before, as it is, and after it was refined.
`sound` are the same walks and the real recordings with the calibration that they came with, which should stay.
"""
import argparse
import concurrent.futures
import json
import math
import os
import pathlib
import random
import sys
import tempfile

sys.dont_write_bytecode = True
from mapping import FRAMES, LAP_S, ROOMS, real_walk, require_walks
from recordings import HERE, Ledger, run

RESULTS = HERE / "calibration_fit.csv"
REAL = ["redkitchen", "hololens", "hololens2"]  # walks of mapping.py
FOCAL, CENTER_PX, TURN_DEG, SHIFT_M = 0.015, 4, 0.7, 0.008  # what a calibration is off: either way, each axis
STATES = ["given", "refined"]
COLUMNS = ["given", "recording", "calibration", "focal_percent", "center_px", "turn_deg", "shift_mm", "ate_rigid_m"]


def read(path):
    """Principal points as if the first pixel's centre were at 0.5, whatever the file says."""
    calibration = json.loads(pathlib.Path(path).read_text())
    for camera in ("color_camera", "depth_camera"):
        for axis in (2, 3):
            calibration[camera]["params"][axis] += 0.5 - calibration.get("pixel_center", 0.5)
    calibration["pixel_center"] = 0.5
    return calibration


def product(a, b):
    """Of two quaternions w x y z."""
    return [a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3], a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
            a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1], a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]]


def spoiled(calibration, seed):
    chance = random.Random(seed)
    bad = json.loads(json.dumps(calibration))
    params, mount = bad["color_camera"]["params"], bad["color_from_depth"]
    longer = 1 + chance.choice((-1, 1)) * FOCAL
    params[0], params[1] = params[0] * longer, params[1] * longer
    params[2], params[3] = params[2] + chance.choice((-1, 1)) * CENTER_PX, params[3] + chance.choice((-1, 1)) * CENTER_PX
    axis = [chance.gauss(0, 1) for _ in range(3)]
    half = math.radians(TURN_DEG) / 2
    turn = [math.cos(half)] + [math.sin(half) * x / math.hypot(*axis) for x in axis]
    mount["q_wxyz"] = product(turn, mount["q_wxyz"])
    for i in range(2):
        mount["t_m"][i] += chance.choice((-1, 1)) * SHIFT_M
    return bad


def off(calibration, truth):
    """What a calibration is off, as the columns have it."""
    params, true_params = calibration["color_camera"]["params"], truth["color_camera"]["params"]
    mount, true_mount = calibration["color_from_depth"], truth["color_from_depth"]
    q = true_mount["q_wxyz"]
    turn = product(mount["q_wxyz"], [q[0], -q[1], -q[2], -q[3]])
    return ["%.2f" % (100 * (params[0] / true_params[0] - 1)), "%.1f" % math.hypot(params[2] - true_params[2], params[3] - true_params[3]),
            "%.2f" % math.degrees(2 * math.asin(min(1, math.hypot(*turn[1:])))),
            "%.1f" % (1000 * math.hypot(*(mount["t_m"][i] - true_mount["t_m"][i] for i in range(2))))]


def rows_of(given, name, tool, source, calibration, truth, folder):
    """Mapped with a calibration, and with what was made of it."""
    model, refined = folder / ("%s_%s.model" % (given, name)), folder / ("%s_%s.json" % (given, name))
    rows = []
    for state, more in zip(STATES, ([], ["--refine-calibration", refined])):
        score = run([tool, "map", *source, "--calibration", calibration, "--model", model, "--force", "--score", "--json", *more])["score"]
        used = read(refined if more else calibration)
        rows.append([given, name, state, *off(used, truth), "%.4f" % score["rigid_rmse_m"]])
    return rows


def measure_room(seed, tool, folder):
    walk = folder / ("room%d" % seed)
    run([tool, "simulate", "--out", walk, "--seed", seed, "--walk-seed", seed, "--frames", FRAMES, "--rate", FRAMES / LAP_S,
         "--threads", 1, "--json"])
    truth = read(walk / "calibration.json")
    bad = folder / ("spoiled%d.json" % seed)
    bad.write_text(json.dumps(spoiled(truth, seed)))
    return (rows_of("spoiled", walk.name, tool, ["--recording", walk], bad, truth, folder) +
            rows_of("sound", walk.name, tool, ["--recording", walk], walk / "calibration.json", truth, folder))


def measure_real(name, tool, folder):
    option, path, _, calibration, *selection = real_walk(name, tool, folder)
    truth = read(calibration)
    return rows_of("sound", name, tool, [option, path, *selection], calibration, truth, folder)


def wanted_rows():
    """What the rows are of: the first columns of each."""
    rooms = ["room%d" % seed for seed in ROOMS]
    return [(given, name, state) for given, names in (("spoiled", rooms), ("sound", REAL + rooms)) for name in names for state in STATES]


def ledger_of(path):
    return Ledger(path, COLUMNS, 2, lambda row: ["spoiled", "sound"].index(row[0]))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spherecloud", required=True)
    parser.add_argument("--results", type=pathlib.Path, default=RESULTS, help="the file to write [calibration_fit.csv]")
    parser.add_argument("--rooms", type=int, default=len(ROOMS), choices=range(0, len(ROOMS) + 1), metavar="N", help="how many [12]")
    arguments = parser.parse_args()
    require_walks(REAL)
    ledger = ledger_of(arguments.results)
    with tempfile.TemporaryDirectory() as scratch, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        folder = pathlib.Path(scratch)
        jobs = [pool.submit(measure_real, name, arguments.spherecloud, folder) for name in REAL]
        jobs += [pool.submit(measure_room, seed, arguments.spherecloud, folder) for seed in ROOMS[:arguments.rooms]]
        ledger.put([row for job in jobs for row in job.result()])


if __name__ == "__main__":
    main()
