"""PoseLib's absolute pose on true points, query by query over stdin and stdout; peer_poselib.cpp is the other end.

Request: u32 points, width, height, 0; u64 seed; f64 fx fy cx cy; f64[2] a pixel each; f64[3] a point each.
Reply: f64[9] R, f64[3] t (camera_from_map), f64 seconds; u32 iterations, inliers, found, 0.
"""
import os
import struct
import sys
import time

os.environ["OMP_NUM_THREADS"] = "1"
ABSENT = 3
try:
    import numpy
    import poselib
except ImportError:
    sys.exit(ABSENT)

REQUEST = struct.Struct("<4IQ4d")
# PoseLib's own options, but without its thousand iterations at least: as fast as it can be.
OPTIONS = {"max_reproj_error": 12.0, "min_iterations": 10, "success_prob": 0.9999}


def read(stream, size):
    data = stream.read(size)
    if len(data) < size:
        sys.exit(0)
    return data


def answer(stream):
    count, width, height, _, seed, fx, fy, cx, cy = REQUEST.unpack(read(stream, REQUEST.size))
    pixels = numpy.frombuffer(read(stream, 16 * count)).reshape(count, 2)
    points = numpy.frombuffer(read(stream, 24 * count)).reshape(count, 3)
    camera = {"model": "PINHOLE", "width": width, "height": height, "params": [fx, fy, cx, cy]}
    options = dict(OPTIONS, seed=seed % 2**31)
    begin = time.perf_counter_ns()
    pose, info = poselib.estimate_absolute_pose(pixels, points, camera, options, {})
    seconds = 1e-9 * (time.perf_counter_ns() - begin)
    inliers = int(info["num_inliers"])
    return struct.pack("<13d4I", *pose.R.ravel(), *pose.t, seconds, int(info["iterations"]), inliers, inliers > 2, 0)


def main():
    incoming, outgoing = os.fdopen(0, "rb"), os.dup(1)
    os.dup2(2, 1)  # whatever a library prints stays out of the way
    os.write(outgoing, b"SPHC")
    while True:
        os.write(outgoing, answer(incoming))


main()
