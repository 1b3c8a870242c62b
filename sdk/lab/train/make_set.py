#!/usr/bin/env python3
"""Makes a training set: pictures of 128 x 128 and the keypoints from which a network shall paint them.

    make_set.py TOOLS OUT --rooms FOLDER...
    make_set.py TOOLS OUT --photos FOLDER       the pictures of photos.txt, which fetch_photos.sh put into FOLDER

TOOLS is the folder with describe_images and dump_points.  Two kinds of samples:
- a frame of a simulated walk with the points of the whole walk's map, hidden ones too, projected onto it: what an
  attacker has who looks at a map;
- a square of a photograph with the keypoints found in it at three sizes, since a map's points were seen from several
  distances.

OUT/set.npz has `truth` (N x 128 x 128, 8 bits), `source` (N: samples of one room or photograph share a number),
`name` (of the sources), `begin` (N + 1) and, of all keypoints, `pixel` and `descriptor`.
"""
import argparse
import os
import subprocess
import tempfile

import cv2
import numpy as np
from view import SIDE, Recording, project

CROP = 480  # px of a photograph that make a picture, about as many as a frame's 50 degrees
SIZES = (288, 480, 720)
CROPS_A_PHOTO = 8
MIN_KEYPOINTS = 300


class Set:
    def __init__(self):
        self.truth, self.source, self.name, self.begin, self.pixel, self.descriptor = [], [], [], [0], [], []

    def add(self, truth, pixel, descriptor, name):
        if len(pixel) < MIN_KEYPOINTS:
            return
        if name not in self.name:
            self.name.append(name)
        self.truth.append(truth)
        self.source.append(self.name.index(name))
        self.begin.append(self.begin[-1] + len(pixel))
        self.pixel.append(pixel.astype(np.float16))
        self.descriptor.append(descriptor)

    def save(self, folder):
        np.savez(os.path.join(folder, "set.npz"), truth=np.stack(self.truth), source=np.array(self.source),
                 name=np.array(self.name), begin=np.array(self.begin), pixel=np.concatenate(self.pixel),
                 descriptor=np.concatenate(self.descriptor))


def read_points(path):
    count = int(np.fromfile(path, np.uint32, 1)[0])
    position = np.fromfile(path, np.float32, 3 * count, offset=4).reshape(count, 3)
    descriptor = np.fromfile(path, np.uint8, 128 * count, offset=4 + 12 * count).reshape(count, 128)
    return position.astype(np.float64), descriptor


def describe(tool, paths):
    """(pixels, descriptors) of each image."""
    with tempfile.TemporaryDirectory() as folder:
        listed, found = os.path.join(folder, "list"), os.path.join(folder, "found")
        with open(listed, "w") as stream:
            stream.write("".join(path + "\n" for path in paths))
        subprocess.run([tool, listed, found], check=True)
        data, at, result = open(found, "rb").read(), 0, []
    for _ in paths:
        count = int(np.frombuffer(data, np.uint32, 1, at)[0])
        pixel = np.frombuffer(data, np.float32, 2 * count, at + 4).reshape(count, 2)
        result.append((pixel, np.frombuffer(data, np.uint8, 128 * count, at + 4 + 8 * count).reshape(count, 128)))
        at += 4 + 136 * count
    return result


def add_room(out, tools, folder):
    with tempfile.NamedTemporaryFile() as dumped:
        subprocess.run([os.path.join(tools, "dump_points"), folder, dumped.name], check=True)
        position, descriptor = read_points(dumped.name)
    recording = Recording(folder)
    for index, (world_from_camera, centre) in enumerate(recording.poses):
        camera_from_world = world_from_camera.T
        pixel, seen = project(position, camera_from_world, -camera_from_world @ centre)
        out.add(recording.view(index), pixel, descriptor[seen], "room " + os.path.basename(folder))


def squares(image, random):
    """Squares of the photograph from fine to whole, spread by chance."""
    short = min(image.shape)
    for _ in range(CROPS_A_PHOTO if short >= CROP else 1):
        side = int(np.exp(random.uniform(np.log(min(CROP, short)), np.log(short))))
        y, x = random.integers(image.shape[0] - side + 1), random.integers(image.shape[1] - side + 1)
        yield image[y:y + side, x:x + side]


def add_photo(out, tools, path, random):
    image = cv2.imread(path, cv2.IMREAD_GRAYSCALE)
    if image is None or min(image.shape) < 240:
        return
    with tempfile.TemporaryDirectory() as folder:
        truths, files = [], []
        for number, square in enumerate(squares(image, random)):
            truths.append(cv2.resize(square, (SIDE, SIDE), interpolation=cv2.INTER_AREA))
            for size in SIZES:
                files.append(os.path.join(folder, f"{number}_{size}.png"))
                method = cv2.INTER_AREA if size < len(square) else cv2.INTER_CUBIC
                cv2.imwrite(files[-1], cv2.resize(square, (size, size), interpolation=method))
        found = describe(os.path.join(tools, "describe_images"), files)
    for number, truth in enumerate(truths):
        parts = found[number * len(SIZES):(number + 1) * len(SIZES)]
        pixel = np.concatenate([p * (SIDE / size) for (p, _), size in zip(parts, SIZES)])
        out.add(truth, pixel, np.concatenate([d for _, d in parts]), "photo " + os.path.basename(path))


def photos(folder):
    listed = os.path.join(os.path.dirname(os.path.abspath(__file__)), "photos.txt")
    return [os.path.join(folder, line.strip()) for line in open(listed) if not line.startswith("#")]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tools")
    parser.add_argument("out")
    parser.add_argument("--rooms", nargs="*", default=[])
    parser.add_argument("--photos")
    options = parser.parse_args()
    cv2.setNumThreads(1)
    os.makedirs(options.out, exist_ok=True)
    out, random = Set(), np.random.Generator(np.random.PCG64(1))
    for folder in options.rooms:
        add_room(out, options.tools, folder)
    for path in photos(options.photos) if options.photos else []:
        add_photo(out, options.tools, path, random)
    out.save(options.out)
    print(f"{len(out.truth)} samples of {len(out.name)} sources, {out.begin[-1]} keypoints")


if __name__ == "__main__":
    main()
