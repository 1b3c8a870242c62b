#!/usr/bin/env python3
"""What does a longer walk cost?  Simulated walks of many lengths through `spherecloud map --score`.

    mapping_growth.py --spherecloud BIN [--world NAME] [--frames N ...]      rewrites mapping_growth.csv, for review
    mapping_growth.py --plot FILE.svg                                        draws what mapping_growth.csv says

At 30 Hz.  In the room they go round and round, so that all of it is seen again and again; in the flat of eight rooms
twice through all.  Time is of a machine that does nothing else; memory is the most that was resident.
"""
import argparse
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
from mapping import ROOMS
from recordings import HERE, read_rows, run, write_csv

RESULTS = HERE / "mapping_growth.csv"
# Options of `simulate`, and how many frames.
WORLDS = {"room": (["--seed", ROOMS[0]], [250, 500, 1000, 2000, 9000]),
          "flat": (["--seed", 1, "--with", "flat"], [2250, 4500, 9000])}
RATE_HZ = 30
COLUMNS = ["world", "frames", "walk_s", "keyframes", "frames_mapped", "parts", "ate_rigid_m", "worst_m", "revisit_worst_m", "scale", "processor_s_a_walk_s",
           "times_faster_than_walk", "most_memory_mib"]


def wanted_rows():
    """What the rows are of: the first columns of each."""
    return [(world, frames) for world, (_, lengths) in WORLDS.items() for frames in lengths]


def measured(command):
    """What a command prints, and its seconds, processor seconds and most memory in KiB."""
    start = time.monotonic()
    with tempfile.TemporaryFile() as out:
        process = subprocess.Popen([str(part) for part in command], stdout=out)
        _, status, usage = os.wait4(process.pid, 0)
        seconds = time.monotonic() - start
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            raise RuntimeError("failed with %d: %s" % (process.returncode, " ".join(map(str, command))))
        out.seek(0)
        return json.load(out), seconds, usage.ru_utime + usage.ru_stime, usage.ru_maxrss


def row_of(world, frames, tool, folder):
    walk = folder / ("%s%d.mcap" % (world, frames))
    if not walk.exists():
        run([tool, "simulate", "--out", walk, *WORLDS[world][0], "--frames", frames, "--rate", RATE_HZ, "--json"])
    with tempfile.TemporaryDirectory() as scratch:
        summary, seconds, processor_s, memory_kib = measured(
            [tool, "map", "--recording", walk, "--model", pathlib.Path(scratch) / "walk.model", "--score", "--json"])
    score, walk_s = summary["score"], frames / RATE_HZ
    return [world, frames, "%.0f" % walk_s, summary["keyframes"], summary["frames_mapped"], summary["parts"],
            "%.4f" % score["rigid_rmse_m"], "%.4f" % score["rigid_worst_m"],
            "%.4f" % score["revisit_worst_m"] if "revisit_worst_m" in score else "", "%.4f" % score["scale"], "%.2f" % (processor_s / walk_s), "%.2f" % (walk_s / seconds), memory_kib // 1024]


def plot(rows, path):
    from matplotlib import rcParams  # Debian: python3-matplotlib
    from matplotlib.figure import Figure

    rcParams["svg.hashsalt"] = "growth"  # the same names in each drawing
    figure = Figure(figsize=(9, 3.2), layout="constrained")
    panels = [("times_faster_than_walk", "length of the walk over the time of map"), ("most_memory_mib", "most memory, MiB"),
              ("ate_rigid_m", "path error, cm")]
    for axes, (column, title) in zip(figure.subplots(1, len(panels)), panels):
        for world in WORLDS:
            own = [row for row in rows if row["world"] == world]
            scale = 100 if column.endswith("_m") else 1
            axes.plot([int(row["frames"]) for row in own], [scale * float(row[column]) for row in own], "o-", label=world)
        axes.set(title=title, xlabel="frames", ylim=(0, None))
        axes.title.set_fontsize(9)
    figure.axes[0].axhline(1, color="grey", linewidth=0.8)
    figure.axes[0].legend()
    figure.savefig(path, metadata={"Date": None})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spherecloud")
    parser.add_argument("--results", type=pathlib.Path, default=RESULTS, help="the file to write, or to draw [mapping_growth.csv]")
    parser.add_argument("--world", choices=WORLDS, action="append", help="these alone; the rows of others stay")
    parser.add_argument("--frames", nargs="+", type=int, metavar="N", help="how many, of each walk")
    parser.add_argument("--walks", type=pathlib.Path, help="a folder that keeps the simulated walks, 1 MB a frame")
    parser.add_argument("--plot", type=pathlib.Path, metavar="FILE", help="draw the results")
    arguments = parser.parse_args()
    if not arguments.spherecloud and not arguments.plot:
        parser.error("--spherecloud BIN measures, --plot FILE draws: give one of them")
    if arguments.spherecloud:
        measure(arguments)
    if arguments.plot:
        plot(read_rows(arguments.results), arguments.plot)


def measure(arguments):
    worlds = arguments.world or list(WORLDS)
    rows = []
    if arguments.results.exists():
        with arguments.results.open(newline="") as file:
            rows = [row for row in list(csv.reader(file))[1:] if row[0] not in worlds]
    with tempfile.TemporaryDirectory() as scratch:
        for world in worlds:
            for frames in arguments.frames or WORLDS[world][1]:
                rows.append(row_of(world, frames, arguments.spherecloud, arguments.walks or pathlib.Path(scratch)))
    order = list(WORLDS)
    rows.sort(key=lambda row: order.index(row[0]))
    write_csv(arguments.results, [COLUMNS, *rows])


if __name__ == "__main__":
    main()
