#!/usr/bin/env python3
"""Whole frames beside package peers, through the command line alone; writes frame.csv.

    frame.py --lab BIN --python PYTHON --out DIR

Maps of 50 000 points of both real recordings, and of 10 000 to 1 000 000 of one, all at eta 33 %.  DIR gets maps, a folder of
figures and drawings a run, and the scaling plot.  PYTHON has the peers' packages (docs/bench.md).
"""
import argparse
import pathlib
import subprocess
import sys

sys.dont_write_bytecode = True
from recordings import HERE, RECORDINGS, Recording, frames

RESULTS = HERE / "frame.csv"
ETA, POINTS = 0.33, 50000
SCALING = (10000, 50000, 200000, 1000000)
PEERS = ("opencv sift, faiss ivf 16", "opencv sift, faiss ivf 8", "opencv sift, hnswlib", "opencv sift, opencv flann",
         "opencv orb, opencv bf")
OURS = ("ours, cold", "ours, tracking", "ours, tracking with odometry")
# What is localized: of the first recording consecutive frames, as a headset sees them; the other has none to spare.
RUNS = {
    "redkitchen": dict(recording="redkitchen", foreign="hololens", query=(620, 739, 1), points=[POINTS], peers=PEERS),
    "hololens": dict(recording="hololens", foreign="redkitchen", query=(1, 199, 2), points=[POINTS], peers=PEERS),
    "scaling": dict(recording="redkitchen", foreign="hololens", query=(620, 679, 1), points=SCALING, ours=OURS[:2],
                    peers=PEERS[:1]),
}


def wanted_rows():
    """What the rows are of: recording, points and variant."""
    return [(name, points, variant) for name, run in RUNS.items() for points in run["points"] for variant in run.get("ours", OURS) + run["peers"]]


def call(tool, *arguments):
    command = [str(part) for part in (tool,) + arguments]
    print("+", *command, flush=True)
    if subprocess.run(command).returncode != 0:
        sys.exit("failed; frame.csv is unchanged")


def maps(tool, run, out):
    recording, foreign = (Recording(run[key], tool, out) for key in ("recording", "foreign"))
    wanted = [option for points in run["points"] for option in ("--points", points)]
    call(tool, "map", *recording.place("map"), *frames(RECORDINGS[run["recording"]]["map"]), *wanted, "--eta", ETA, "--foreign",
         foreign.folder, "--foreign-calibration", HERE / "calibration" / (foreign.name + ".json"), "--out", out)
    return [option for points in run["points"] for option in ("--map", out / ("map_%d.sphc" % points))]


def measure(tool, python, name, out):
    run = RUNS[name]
    recording = Recording(run["recording"], tool, out)
    mapped = [option.replace("--", "--mapping-") if isinstance(option, str) else option
              for option in frames(RECORDINGS[run["recording"]]["map"])]
    only = [option for variant in run.get("ours", OURS) + run["peers"] for option in ("--only", variant)]
    folder, part = out / name, out / (name + ".csv")
    call(tool, "frame", *recording.place("query"), *frames(run["query"]), *maps(tool, run, out / "maps" / name), *mapped, *only, "--name", name,
         "--python", python, "--out", folder, "--results", part)
    return part.read_text().splitlines()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lab", required=True, help="the command spherecloud-lab")
    parser.add_argument("--python", default="python3", help="Python with the peers' packages")
    parser.add_argument("--out", required=True, type=pathlib.Path, help="folder for maps, figures and drawings")
    arguments = parser.parse_args()
    for name in {run["recording"] for run in RUNS.values()}:
        folder = Recording(name, arguments.lab, arguments.out).folder
        if not folder.is_dir():
            sys.exit("%s is not there; set SPHC_DATA" % folder)
    lines = []
    for name in RUNS:
        head, *rows = measure(arguments.lab, arguments.python, name, arguments.out)
        lines += ([] if lines else [head]) + rows
    RESULTS.write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
