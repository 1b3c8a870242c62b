#!/usr/bin/env python3
"""What does a longer walk cost?  Simulated walks of many lengths through `spherecloud map --score`.

    mapping_growth.py --spherecloud BIN [--frames N ...]      rewrites mapping_growth.csv, for review

They go round and round in one room at 30 Hz, so that all of it is seen again and again.  Time is of a machine that does
nothing else; memory is the most that was resident.
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
from recordings import HERE, run

RESULTS = HERE / "mapping_growth.csv"
FRAMES = [250, 500, 1000, 2000, 9000]
RATE_HZ = 30
COLUMNS = ["frames", "walk_s", "keyframes", "frames_mapped", "parts", "ate_rigid_m", "scale", "processor_s_a_walk_s", "times_faster_than_walk",
           "most_memory_mib"]


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


def row_of(frames, tool, folder):
    walk = folder / ("walk%d.mcap" % frames)
    if not walk.exists():
        run([tool, "simulate", "--out", walk, "--seed", ROOMS[0], "--frames", frames, "--rate", RATE_HZ, "--json"])
    with tempfile.TemporaryDirectory() as scratch:
        summary, seconds, processor_s, memory_kib = measured(
            [tool, "map", "--recording", walk, "--model", pathlib.Path(scratch) / "walk.model", "--score", "--json"])
    score, walk_s = summary["score"], frames / RATE_HZ
    return [frames, "%.0f" % walk_s, summary["keyframes"], summary["frames_mapped"], summary["parts"], "%.4f" % score["rigid_rmse_m"],
            "%.4f" % score["scale"], "%.2f" % (processor_s / walk_s), "%.2f" % (walk_s / seconds), memory_kib // 1024]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spherecloud", required=True)
    parser.add_argument("--results", type=pathlib.Path, default=RESULTS, help="the file to write [mapping_growth.csv]")
    parser.add_argument("--frames", nargs="+", type=int, default=FRAMES, metavar="N", help="how many, of each walk [%(default)s]")
    parser.add_argument("--walks", type=pathlib.Path, help="a folder that keeps the simulated walks, 1 MB a frame")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        rows = [row_of(frames, arguments.spherecloud, arguments.walks or pathlib.Path(scratch)) for frames in arguments.frames]
    with arguments.results.open("w", newline="") as out:
        csv.writer(out, lineterminator="\n").writerows([COLUMNS, *rows])


if __name__ == "__main__":
    main()
