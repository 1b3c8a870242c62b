#!/usr/bin/env python3
"""The holder's hands and feet stay out of a map, and the room stays in it: through the command line, of a simulated walk.

    moving.py --spherecloud BIN
"""
import argparse
import json
import math
import pathlib
import struct
import sys
import tempfile

sys.dont_write_bytecode = True
from recordings import ran

WALK = ["--frames", 20, "--rate", 1.25, "--seed", 3001, "--walk-seed", 3001]  # one lap
HEADER, POINT = 32, 164  # bytes of a saved model and of a point in it, docs/private_model.md
# The walk keeps 0.6 m from furniture.  What is nearer to its line and above the carpet is the holder.
NEAR_M, FLOOR_M, HIP_M = 0.4, 0.05, 0.9
FEWEST_ON_LEGS = 100     # with the option off; else the test shows nothing
MOST_LEFT = 0.1          # of them
MOST_OF_ROOM = 0.01      # of the points of a room in which nothing moves


def holder_places(walk):
    lines = (walk / "groundtruth.txt").read_text().splitlines()
    return [tuple(map(float, line.split()[1:3])) for line in lines if not line.startswith("#")]


def points_on_legs(model, places):
    data = model.read_bytes()
    points = [struct.unpack_from("<3d", data, at) for at in range(HEADER, len(data), POINT)]
    return sum(FLOOR_M < z < HIP_M and min(math.dist((x, y), place) for place in places) < NEAR_M for x, y, z in points)


def mapped(tool, walk, name, *more):
    """The saved model, and what the command says about it."""
    model = walk.parent / (name + ".model")
    told = ran([tool, "build", "--recording", walk, "--map", walk.parent / (name + ".sphc"), "--ledger",
                walk.parent / (name + ".ledger"), "--save-model", model, "--json", *more])
    return model, json.loads(told.stdout)


def faults(tool, folder):
    walk, still = folder / "walk", folder / "still"
    ran([tool, "simulate", "--out", walk, "--with", "hands,feet", *WALK])
    places = holder_places(walk)
    (all_points, whole), (points, kept) = mapped(tool, walk, "all", "--keep-moving"), mapped(tool, walk, "kept")
    before, after = points_on_legs(all_points, places), points_on_legs(points, places)
    dropped = kept["points_seen_through"] + kept["points_within_reach"]
    print("%d points, %d of them on legs; %d dropped, %d on legs left" % (whole["points_kept"], before, dropped, after))
    if whole["points_seen_through"] or whole["points_within_reach"]:
        yield "--keep-moving drops points"
    if before < FEWEST_ON_LEGS:
        yield "only %d points are on legs: the test shows nothing" % before
    if after > MOST_LEFT * before:
        yield "%d of %d points on legs are left" % (after, before)
    if not whole["points_kept"] - 1.2 * dropped < kept["points_kept"] < whole["points_kept"] - 0.8 * dropped:
        yield "the numbers that the command tells do not fit together"

    ran([tool, "simulate", "--out", still, *WALK])
    _, room = mapped(tool, still, "room")
    dropped = room["points_seen_through"] + room["points_within_reach"]
    print("nothing moves: %d of %d points dropped" % (dropped, room["points_kept"]))
    if dropped > MOST_OF_ROOM * room["points_kept"]:
        yield "%d points of a room in which nothing moves are dropped" % dropped


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spherecloud", required=True, help="the command")
    tool = parser.parse_args().spherecloud
    with tempfile.TemporaryDirectory() as folder:
        found = list(faults(tool, pathlib.Path(folder)))
    sys.exit("\n".join(found) if found else 0)


if __name__ == "__main__":
    main()
