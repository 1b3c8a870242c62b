"""The golden session that C wrote, as the tests use it."""
import csv
import os
import pathlib
import sys

import numpy as np

import spherecloud as sphc

FOLDER = pathlib.Path(os.environ["SPHERECLOUD_GOLDEN"])
MAP = FOLDER / "room.sphc"


def rows(name):
    with open(FOLDER / name, encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


CONFIG = {row["field"]: float(row["value"]) for row in rows("config.csv")}
MAP_ID = int(CONFIG["map_id"])
ROWS = rows("session.csv")


def camera(row):
    focal = [float(row[name]) for name in ("fx", "fy", "cx", "cy")]
    return sphc.Camera(sphc.CameraModel(int(row["model"])), int(row["width"]), int(row["height"]), focal)


COLOR, DEPTH = (camera(row) for row in rows("cameras.csv"))
RIG = sphc.Rig(COLOR, DEPTH, sphc.Rigid(t_m=(CONFIG["color_from_depth_x_m"], 0, 0)))


def localizer(maps=None, **options):
    return sphc.Localizer(RIG, maps, max_keypoints=int(CONFIG["max_keypoints"]), depth_sigma_m=CONFIG["depth_sigma_m"], **options)


def prior(row):
    vertical = (0, -1, 0)
    return sphc.Prior(MAP_ID, up_camera=vertical, up_map=vertical, up_sigma_rad=float(row["up_sigma_rad"]))


def frame(row, **more):
    color = np.fromfile(FOLDER / row["color_file"], np.uint8).reshape(COLOR.height, COLOR.width)
    depth = np.fromfile(FOLDER / row["depth_file"], np.uint16).reshape(DEPTH.height, DEPTH.width)
    more.setdefault("prior", prior(row) if row["has_up"] == "1" else None)
    return sphc.Frame(color, depth, int(row["color_time_ns"]), int(row["depth_time_ns"]), int(row["sequence"]), **more)


def numbers(pose):
    return [*pose.q_wxyz, *pose.t_m]


def wanted(row, prefix=""):
    return [float(row[f"{prefix}{name}"]) for name in ("q_w", "q_x", "q_y", "q_z", "t_x", "t_y", "t_z")]


def same(result, row):
    """The result is that of C, to the last bit."""
    found = [int(not result.localized) * 2, result.outcome, result.state, result.keypoints, result.inliers, result.confidence,
             *numbers(result.camera_from_map), result.covariance[0, 0], result.covariance[5, 5], result.sequence]
    told = [float(row[name]) for name in ("status", "outcome", "state", "keypoints", "inliers", "confidence")]
    return found == [*told, *wanted(row), float(row["covariance_0"]), float(row["covariance_35"]), int(row["sequence"])]


def play(localizer):
    """Whether all frames, and the predictions after each, are those of C."""
    good = []
    for row in ROWS:
        good.append(same(localizer.process(frame(row)), row))
        later = localizer.predict(int(row["color_time_ns"]) + 20_000_000)
        good.append(numbers(later.camera_from_map) == wanted(row, "predicted_") and
                    later.known == (row["predicted_status"] == "0"))
    return len(good) == 20 and all(good)


if __name__ == "__main__":  # of the test of the wheel
    with sphc.Map.open(MAP) as room, localizer({MAP_ID: room}) as made:
        print(sphc.__file__, sphc._library.path())
        sys.exit(not play(made))
