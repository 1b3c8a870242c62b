"""The virtual camera that all of this looks through, and readers of recordings in the TUM layout."""
import json
import os

import cv2
import numpy as np

SIDE = 128  # px, both ways; pixel centres at .5 as everywhere in the SDK
FIELD_DEG = 50.0
FOCAL = SIDE / 2 / np.tan(np.radians(FIELD_DEG / 2))
NEAR_M = 0.2


def project(points, camera_from_world, translation):
    """Pixels of those points that fall into the view, and which they are."""
    seen = points @ camera_from_world.T + translation
    front = seen[:, 2] > NEAR_M
    pixel = FOCAL * seen[:, :2] / np.where(front, seen[:, 2], 1)[:, None] + SIDE / 2
    inside = np.flatnonzero(front & (pixel >= 0).all(1) & (pixel < SIDE).all(1))
    return pixel[inside], inside


def rotation(q_xyzw):
    x, y, z, w = q_xyzw / np.linalg.norm(q_xyzw)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


class Recording:
    """A simulated walk: `frames` is a list of (grey image, world_from_camera rotation, position)."""

    def __init__(self, folder):
        camera = json.load(open(os.path.join(folder, "calibration.json")))["color_camera"]
        fx, fy, cx, cy, k1, k2, p1, p2, k3 = camera["params"]
        lens = np.array([[fx, 0, cx - .5], [0, fy, cy - .5], [0, 0, 1]])  # OpenCV's centres are at 0
        self._lens, self._distortion = lens, np.array([k1, k2, p1, p2, k3])
        fine = 3 * SIDE
        pinhole = np.array([[3 * FOCAL, 0, fine / 2 - .5], [0, 3 * FOCAL, fine / 2 - .5], [0, 0, 1]])
        self._map = cv2.initUndistortRectifyMap(lens, self._distortion, None, pinhole, (fine, fine),
                                                cv2.CV_32FC1)
        self._folder = folder
        poses = np.loadtxt(os.path.join(folder, "groundtruth.txt"), ndmin=2)
        names = [line.split() for line in open(os.path.join(folder, "rgb.txt")) if not line.startswith("#")]
        self.poses = [(rotation(pose[4:]), pose[1:4]) for pose in poses]
        self.files = [name for _, name in names]

    def view(self, index):
        """Frame `index` as the virtual camera at its place sees it: SIDE x SIDE, 8 bits."""
        image = cv2.imread(os.path.join(self._folder, self.files[index]), cv2.IMREAD_GRAYSCALE)
        fine = cv2.remap(image, *self._map, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
        return cv2.resize(fine, (SIDE, SIDE), interpolation=cv2.INTER_AREA)

    def to_view(self, pixel):
        """Pixels of a frame as pixels of the virtual camera at its place."""
        flat = cv2.undistortPoints((pixel - .5).astype(np.float64)[:, None], self._lens, self._distortion)[:, 0]
        return FOCAL * flat + SIDE / 2
