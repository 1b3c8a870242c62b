#!/usr/bin/env python3
"""Poses for a folder of frames.

    first_pose.py MAP.sphc FOLDER

FOLDER has images as numpy keeps them, 30 a second: 0000_color.npy (240 x 320, uint8) and 0000_depth.npy (160 x 200,
uint16, millimetres).
"""
import pathlib
import sys

import numpy as np

from spherecloud import Camera, Frame, Localizer, Map, Rig, Rigid

color, depth = Camera.pinhole(320, 240, 250, 250, 160, 120), Camera.pinhole(200, 160, 140, 140, 100, 80)
rig = Rig(color, depth, color_from_depth=Rigid(t_m=(0.04, 0, 0)))

with Map.open(sys.argv[1]) as map, Localizer(rig, map) as localizer:
    for index, path in enumerate(sorted(pathlib.Path(sys.argv[2]).glob("*_color.npy"))):
        depth_path = path.with_name(path.name.replace("color", "depth"))
        time_ns = index * 33_333_333  # mid-exposure
        result = localizer.process(Frame(np.load(path), np.load(depth_path), time_ns, time_ns))
        print(index, result.pose.inverse().t_m if result.pose else result.outcome.name)
