#!/usr/bin/env python3
"""What overhead.c does, through the Python package: a line in, a line with processor times out.

    overhead.py FOLDER
"""
import pathlib
import sys
import time

import numpy as np

from spherecloud import Camera, Frame, Localizer, Map, Rig, Rigid

FRAMES, PREDICTIONS = 10, 1000


def images(folder):
    return [(np.fromfile(folder / f"color_{i:02}.gray8", np.uint8).reshape(240, 320),
             np.fromfile(folder / f"depth_{i:02}.depth16", np.uint16).reshape(160, 200)) for i in range(FRAMES)]


def play(localizer, frames):
    times = []
    localizer.reset()
    for index, (color, depth) in enumerate(frames):
        before = time.thread_time_ns()
        time_ns = 1_000_000_000 + 33_000_000 * index
        pose = localizer.process(Frame(color, depth, time_ns, time_ns)).pose
        times.append(time.thread_time_ns() - before)
        del pose
    before = time.thread_time_ns()
    for later_ns in range(PREDICTIONS):
        localizer.predict(time_ns + later_ns)
    return [*times, (time.thread_time_ns() - before) // PREDICTIONS]


def main(folder):
    rig = Rig(Camera.pinhole(320, 240, 250, 250, 160, 120), Camera.pinhole(200, 160, 140, 140, 100, 80), Rigid(t_m=(0.04, 0, 0)))
    frames = images(folder)
    with Map.open(folder / "room.sphc") as room, Localizer(rig, room) as localizer:
        for _ in sys.stdin:
            print(*play(localizer, frames), flush=True)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
