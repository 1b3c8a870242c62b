#!/usr/bin/env python3
"""Poses for a folder of frames.

    first_pose.py MAP.sphc FOLDER

FOLDER has images as bare bytes, 30 a second: color_00.gray8 (240 x 320) and depth_00.depth16 (160 x 200, millimetres).
"""
import pathlib
import sys

import numpy as np

from spherecloud import Camera, Frame, Localizer, Map, Rig, Rigid

color, depth = Camera.pinhole(320, 240, 250, 250, 160, 120), Camera.pinhole(200, 160, 140, 140, 100, 80)
rig = Rig(color, depth, color_from_depth=Rigid(t_m=(0.04, 0, 0)))

if len(sys.argv) != 3:
    sys.exit(__doc__)
with Map.open(sys.argv[1]) as map, Localizer(rig, map) as localizer:
    for index, path in enumerate(sorted(pathlib.Path(sys.argv[2]).glob("color_*.gray8"))):
        gray = np.fromfile(path, np.uint8).reshape(240, 320)
        depth_mm = np.fromfile(path.with_name(f"depth_{index:02}.depth16"), np.uint16).reshape(160, 200)
        time_ns = index * 33_333_333  # mid-exposure
        result = localizer.process(Frame(gray, depth_mm, time_ns, time_ns))
        print(index, result.pose.inverse().t_m if result.pose else result.outcome.name)
