#!/usr/bin/env python3
"""Golden vectors of the conventions of poses: conventions.csv, which is installed beside spherecloud.json for bindings.

    make_conventions.py [--check]     writes sdk/include/spherecloud/conventions.csv, or compares it with what is computed

Computed from what the directions mean (right, down, forward, up), not by the library: a pose's rotation has as columns
the axes of what is placed, in coordinates of where it is placed.  No conversion is a product of two rotations here.
"""
import argparse
import csv
import io
import pathlib
import sys

import numpy as np

OUT = pathlib.Path(__file__).resolve().parents[2] / "sdk" / "include" / "spherecloud" / "conventions.csv"
X, Y, Z = np.eye(3)
RIGID = ["qw", "qx", "qy", "qz", "x", "y", "z"]
COLUMNS = (["scene", "convention"] + ["up_map_" + a for a in "xyz"] + ["world_from_map_" + n for n in RIGID] +
           ["camera_from_map_" + n for n in RIGID] + [f"camera_pose_{i}" for i in range(7)] +
           [f"map_pose_{i}" for i in range(7)])


def quaternion(matrix):
    """(w, x, y, z) of a rotation, the first that is not 0 positive: the eigenvector to the largest eigenvalue
    (Bar-Itzhack 2000)."""
    m = matrix
    k = np.array([[m[0, 0] + m[1, 1] + m[2, 2], m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]],
                  [m[2, 1] - m[1, 2], m[0, 0] - m[1, 1] - m[2, 2], m[0, 1] + m[1, 0], m[0, 2] + m[2, 0]],
                  [m[0, 2] - m[2, 0], m[0, 1] + m[1, 0], m[1, 1] - m[0, 0] - m[2, 2], m[1, 2] + m[2, 1]],
                  [m[1, 0] - m[0, 1], m[0, 2] + m[2, 0], m[1, 2] + m[2, 1], m[2, 2] - m[0, 0] - m[1, 1]]])
    q = np.linalg.eigh(k)[1][:, -1]
    q = q * np.sign(q[np.argmax(abs(q) > 1e-9)])
    for axis in (X, Y, Z):  # it turns each axis where the matrix takes it
        twice = 2 * np.cross(q[1:], axis)
        assert np.allclose(axis + q[0] * twice + np.cross(q[1:], twice), matrix @ axis, atol=1e-14)
    return q


def about(axis, radians):
    """Rotation about a unit axis (Rodrigues)."""
    k = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + np.sin(radians) * k + (1 - np.cos(radians)) * (k @ k)


class Camera:
    """Where it is in the map and what is right, down and forward of it there."""

    def __init__(self, position, right, down, forward):
        self.position, self.right, self.down, self.forward = (np.asarray(v, float) for v in (position, right, down, forward))
        assert np.allclose(np.cross(self.right, self.down), self.forward, atol=1e-14)

    @staticmethod
    def turned(position, rotation):
        return Camera(position, *rotation.T)

    def from_map(self):
        """The axes of OpenCV are right, down, forward."""
        rows = np.array([self.right, self.down, self.forward])
        return rows, -np.array([row @ self.position for row in rows])


class World:
    """A right-handed frame: its axes and its origin, in the map."""

    def __init__(self, axes, origin=(0, 0, 0)):
        self.axes, self.origin = np.array(axes, float), np.asarray(origin, float)

    def of(self, direction):
        return np.array([axis @ direction for axis in self.axes])

    def at(self, point):
        return self.of(point - self.origin)

    def from_map(self):
        return self.axes, self.at(np.zeros(3))


def level(up, y_is):
    """The world that is level: `y_is` up or down, or None where z is up."""
    up = np.asarray(up, float) / np.linalg.norm(up)
    axis = np.cross(up, Z)
    length = np.linalg.norm(axis)
    turn = about(axis / length, np.arctan2(length, up[2])) if length > 0 else about(X, 0 if up[2] > 0 else np.pi)
    ahead, aside = turn[0], turn[1]  # of the map: what x and y of a frame with z up are
    return World({None: (ahead, aside, up), "up": (ahead, up, -aside), "down": (ahead, -up, aside)}[y_is])


class Convention:
    def __init__(self, y_is, camera_axes, order, left_handed=False, camera_from_world=False):
        self.y_is, self.camera_axes, self.order = y_is, camera_axes, order
        self.left_handed, self.camera_from_world = left_handed, camera_from_world

    def mirrored(self, v):
        return v * [1, 1, -1] if self.left_handed else v

    def numbers(self, rotation, position):
        q = quaternion(rotation)
        parts = dict(zip(RIGID, [*q, *position]))
        return [parts[name] for name in self.order.split()]

    def camera_pose(self, world, camera):
        axes = self.camera_axes(camera.right, camera.down, camera.forward)
        columns = np.array([self.mirrored(world.of(axis)) for axis in axes]).T
        position = self.mirrored(world.at(camera.position))
        if self.camera_from_world:
            columns, position = columns.T, -np.array([column @ position for column in columns.T])
        return self.numbers(columns, position)

    def map_pose(self, world):
        axes = (X, Y, -Z if self.left_handed else Z)
        columns = np.array([self.mirrored(world.of(axis)) for axis in axes]).T
        return self.numbers(columns, self.mirrored(world.at(np.zeros(3))))


def as_opencv(right, down, forward):
    return right, down, forward


POSITION_FIRST = "x y z qx qy qz qw"
CONVENTIONS = {
    "OPENXR": Convention("up", lambda right, down, forward: (right, -down, -forward), "qx qy qz qw x y z"),
    "UNITY": Convention("up", lambda right, down, forward: (right, -down, forward), POSITION_FIRST, left_handed=True),
    "ROS_OPTICAL": Convention(None, as_opencv, POSITION_FIRST),
    "ROS_FLU": Convention(None, lambda right, down, forward: (forward, -right, -down), POSITION_FIRST),
    "COLMAP": Convention("down", as_opencv, "qw qx qy qz x y z", camera_from_world=True),
    "TUM": Convention(None, as_opencv, POSITION_FIRST),
}
NO_VERTICAL = ("COLMAP", "TUM")

ANY_CAMERA = Camera.turned((1.25, -3.5, 0.75), about(Z, 0.7) @ about(X, -2.1) @ about(Y, 0.4))
# In a map with z up, one metre above its origin, unless said otherwise.
SCENES = {
    "looks along x": (Z, Camera(Z, -Y, -Z, X)),
    "a quarter turn to the left of it": (Z, Camera(Z, X, -Z, Y)),
    "a quarter turn upwards of it": (Z, Camera(Z, -Y, X, Z)),
    "rolled by a quarter turn to the right": (Z, Camera(Z, -Z, Y, X)),
    "at the origin of a map with y down": (-Y, Camera((0, 0, 0), X, Y, Z)),
    "looks along -z in a map with y up": (Y, Camera((2, 1.5, -3), X, -Y, -Z)),
    "looks along z in a map with x up": (X, Camera((0.5, 2, 4), Y, -X, Z)),
    "looks along z in a map with x down": (-X, Camera((0.5, 2, 4), -Y, X, Z)),
    "looks along x in a map with z down": (-Z, Camera((3, 2, -1), Y, Z, X)),
    "any pose in a map with nearly z down": ((0.00981, -0.01962, -9.81), ANY_CAMERA),
    "any pose in any map": ((-0.3, 0.2, 0.5), ANY_CAMERA),
}
PLACED = {
    "any pose in any map that lies anywhere": (World(about(X, 0.3) @ about(Y, -1.9) @ about(Z, 2.8), (10, -20, 0.5)), ANY_CAMERA),
    "looks along x in a map that lies turned by half": (World((-X, -Y, Z), (4, 0, 0)), SCENES["looks along x"][1]),
}


def row(scene, name, up, world, camera):
    convention = CONVENTIONS[name]

    def rigid(transform):
        return [*quaternion(transform[0]), *transform[1]]

    told = World(np.eye(3)) if world is None else world
    numbers = [[""] * 3 if up is None else up, [""] * 7 if world is None else rigid(world.from_map()),
               rigid(camera.from_map()), convention.camera_pose(told, camera), convention.map_pose(told)]
    return [scene, name] + [value if value == "" else repr(round(float(value), 14) + 0.0) for part in numbers for value in part]


def rows():
    for name, convention in CONVENTIONS.items():
        for scene, (up, camera) in SCENES.items():
            yield row(scene, name, up, level(up, convention.y_is), camera)
        for scene, (world, camera) in PLACED.items():
            yield row(scene, name, None, world, camera)
        if name in NO_VERTICAL:
            for scene in ("looks along x", "any pose in any map"):
                yield row(scene, name, None, None, SCENES[scene][1])


def differ(one, other):
    """Last digits may: they hang on the version of numpy."""
    try:
        return abs(float(one) - float(other)) > 1e-13
    except ValueError:
        return one != other


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    now = [COLUMNS, *rows()]
    if not parser.parse_args().check:
        text = io.StringIO()
        csv.writer(text, lineterminator="\n").writerows(now)
        OUT.write_text(text.getvalue())
        return
    with open(OUT, encoding="utf-8") as stream:
        pinned = list(csv.reader(stream))
    if len(pinned) != len(now):
        sys.exit(f"{OUT.name} has {len(pinned)} lines, {len(now)} are computed: build the target conventions_csv")
    for was, told in zip(pinned, now):
        if len(was) != len(told) or any(map(differ, was, told)):
            sys.exit(f"{OUT.name} differs from what is computed: build the target conventions_csv\n- {was}\n+ {told}")


if __name__ == "__main__":
    main()
