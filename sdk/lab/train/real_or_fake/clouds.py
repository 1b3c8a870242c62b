"""The files of publish_cloud, cloud_features and cloud_stacks."""
import numpy as np


def read_cloud(path):
    """(directions, descriptors, which are real, patches)"""
    count = int(np.fromfile(path, np.uint32, 1)[0])
    directions = np.fromfile(path, np.float32, 3 * count, offset=4).reshape(count, 3)
    descriptors = np.fromfile(path, np.uint8, 128 * count, offset=4 + 12 * count).reshape(count, 128)
    real = np.fromfile(path, np.uint8, count, offset=4 + 140 * count)
    patches = np.fromfile(path, np.uint32, count, offset=4 + 141 * count)
    return directions, descriptors, real.astype(bool), patches


def read_features(path):
    """(features, neighbours in direction, which are real)"""
    points, features, neighbours = map(int, np.fromfile(path, np.uint32, 3))
    at = 12
    values = np.fromfile(path, np.float32, points * features, offset=at).reshape(points, features)
    at += 4 * values.size
    beside = np.fromfile(path, np.int32, points * neighbours, offset=at).reshape(points, neighbours)
    at += 4 * beside.size
    return values, beside, np.fromfile(path, np.uint8, points, offset=at).astype(bool)


def read_stacks(path):
    """(stack of each point, features)"""
    points, features = map(int, np.fromfile(path, np.uint32, 2))
    stacks = np.fromfile(path, np.uint32, points, offset=8)
    return stacks, np.fromfile(path, np.float32, points * features, offset=8 + 4 * points).reshape(points, features)
