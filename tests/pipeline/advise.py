#!/usr/bin/env python3
"""Advice on a short recording of the simulated headset: what it expects, what it draws, what it refuses.

    advise.py --spherecloud BIN
"""
import argparse
import json
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
from recordings import ran

FRAMES, FOLDS = 16, 2
LEAST_POINTS = 300
LEAST_RECALL = 0.9  # of all points: half the walk is mapped, the other half localized


def faults(advice):
    shares = {row["eta"]: row["good"] / row["frames"] for row in advice["recall"]}
    print("%d points, %.0f %% covered, recall by eta %s" % (advice["points"], advice["covered_percent"], shares))
    if advice["points"] < LEAST_POINTS:
        yield "only %d points" % advice["points"]
    if not 0 < advice["covered_percent"] < 100 or not 0 < advice["evenness_percent"] < 100:
        yield "half a walk covers neither nothing nor all"
    if not advice["holes"]:
        yield "no direction is without points"
    if any(row["frames"] != FRAMES for row in advice["recall"]):
        yield "not every frame was held out once"
    if shares[1] < LEAST_RECALL:
        yield "recall %.2f without fakes" % shares[1]
    if shares[0.25] > shares[1]:
        yield "fakes made frames easier to localize"
    judged = next(row for row in advice["recall"] if row["eta"] == 0.33)
    if len(advice["failures"]) != judged["frames"] - judged["good"]:
        yield "%d failures are told" % len(advice["failures"])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spherecloud", required=True, help="the command")
    tool = parser.parse_args().spherecloud
    with tempfile.TemporaryDirectory() as folder:
        walk, picture = pathlib.Path(folder) / "walk", pathlib.Path(folder) / "advice.png"
        ran([tool, "simulate", "--out", walk, "--frames", FRAMES, "--rate", 6])
        advise = [tool, "advise", "--recording", walk, "--folds", FOLDS, "--json"]
        found = list(faults(json.loads(ran([*advise, "--picture", picture]).stdout)))
        if not picture.exists():
            found.append("no picture")
        few = ran([tool, "advise", "--recording", walk, "--folds", FRAMES], accepted=(1,))
        if "too few" not in few.stderr:
            found.append("too few frames are refused by: " + few.stderr)
    sys.exit("\n".join(found) if found else 0)


if __name__ == "__main__":
    main()
