#!/usr/bin/env python3
"""Shows that no training picture sees an audited place.

    check_overlap.py SET... --maps MAP.sphc... [--control RECORDING...]

Keypoints of training pictures (at least 3 pictures of each source) are matched with the points of each map: nearest
descriptor, ratio test against the nearest in another direction.  Matches count when one rotation brings keypoints
and points together within 4 degrees, which near-duplicates, and views of one place from about the map's centre, do.
--control: recordings of the mapped places, which must be found.  Prints the most matches of any training picture,
and those of the controls; exits with 1 where a training picture has as many as `FOUND`.
"""
import argparse
import os
import sys

import numpy as np
from view import FOCAL, SIDE, Recording

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../../tests/support"))
import read_map  # noqa: E402

KEYPOINTS = 250
RATIO = .8
DUPLICATE = np.cos(np.radians(3))
TOGETHER = np.cos(np.radians(4))
TRIES = 200
FOUND = 12


class Place:
    def __init__(self, path):
        cloud = read_map.read(open(path, "rb").read())
        self.name = os.path.basename(path)
        self.direction = np.array(cloud.directions)
        self.descriptor = np.frombuffer(cloud.descriptors, np.uint8).reshape(-1, 128).astype(np.float32)
        self.square = (self.descriptor ** 2).sum(1)

    def match(self, descriptor):
        """(rows of `descriptor`, points) that pass the ratio test."""
        descriptor = descriptor.astype(np.float32)
        distance = self.square - 2 * descriptor @ self.descriptor.T + (descriptor ** 2).sum(1)[:, None]
        few = np.argpartition(distance, 8, 1)[:, :8]
        rows = np.arange(len(few))
        few = np.take_along_axis(few, np.take_along_axis(distance, few, 1).argsort(1), 1)
        best = few[:, 0]
        other = np.einsum("nkd,nd->nk", self.direction[few], self.direction[best]) < DUPLICATE
        has_other = other.any(1)
        second = np.where(has_other, few[rows, other.argmax(1)], few[:, -1])
        good = distance[rows, best] < RATIO ** 2 * distance[rows, second]
        return np.flatnonzero(good), best[good]

    def agreeing(self, pixel, descriptor, random):
        """Most matches that one rotation explains."""
        rows, points = self.match(descriptor)
        if len(rows) < 3:
            return 0
        ray = np.concatenate([(pixel[rows] - SIDE / 2) / FOCAL, np.ones((len(rows), 1))], 1)
        ray /= np.linalg.norm(ray, axis=1)[:, None]
        direction, most = self.direction[points], 0
        for _ in range(TRIES):
            a, b = random.choice(len(rows), 2, False)
            rotation = frame(direction[a], direction[b]).T @ frame(ray[a], ray[b])
            most = max(most, int((np.einsum("nd,nd->n", ray @ rotation.T, direction) > TOGETHER).sum()))
        return most


def frame(first, second):
    """Rows: an orthonormal frame of two directions."""
    across = np.cross(first, second)
    across /= np.linalg.norm(across) + 1e-12
    return np.stack([first, across, np.cross(first, across)])


def few_of(count, random, most):
    return random.permutation(count)[:most]


def training_pictures(folders, random):
    for folder in folders:
        data = np.load(os.path.join(folder, "set.npz"))
        pixel, descriptor, begin, source = data["pixel"], data["descriptor"], data["begin"], data["source"]
        for number, name in enumerate(data["name"]):
            samples = np.flatnonzero(source == number)
            for index in samples[few_of(len(samples), random, 8 if name.startswith("room") else 3)]:
                chosen = begin[index] + few_of(begin[index + 1] - begin[index], random, KEYPOINTS)
                yield f"{name} #{index}", pixel[chosen].astype(np.float64), descriptor[chosen]


def control_pictures(tools, folder, random):
    from make_set import describe
    recording = Recording(folder)
    files = [os.path.join(folder, recording.files[i]) for i in range(0, len(recording.files), 20)]
    for pixel, descriptor in describe(os.path.join(tools, "describe_images"), files):
        chosen = few_of(len(pixel), random, KEYPOINTS)
        yield recording.to_view(pixel[chosen]), descriptor[chosen]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sets", nargs="+")
    parser.add_argument("--maps", nargs="+", required=True)
    parser.add_argument("--tools")
    parser.add_argument("--control", nargs="*", default=[])
    options = parser.parse_args()
    places, random = [Place(path) for path in options.maps], np.random.Generator(np.random.PCG64(1))
    scores = []
    for name, pixel, descriptor in training_pictures(options.sets, random):
        scores += [(place.agreeing(pixel, descriptor, random), name, place.name) for place in places]
    counts = np.array([score for score, _, _ in scores])
    print(f"{len(scores) // len(places)} training pictures, {len(places)} maps; agreeing matches: median "
          f"{np.median(counts):.0f}, 99.9 % {np.quantile(counts, .999):.0f}, most {counts.max()}; the ten highest:")
    for score, name, place in sorted(scores, reverse=True)[:10]:
        print(f"  {score} {name} in {place}")
    for folder in options.control:
        found = np.array([max(place.agreeing(pixel, descriptor, random) for place in places)
                          for pixel, descriptor in control_pictures(options.tools, folder, random)])
        print(f"control {os.path.basename(folder)}: median {np.median(found):.0f}, "
              f"{np.mean(found >= FOUND) * 100:.0f} % of {len(found)} pictures at {FOUND} or more")
    sys.exit(1 if counts.max() >= FOUND else 0)


if __name__ == "__main__":
    main()
