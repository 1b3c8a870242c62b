#!/usr/bin/env python3
"""Learns which descriptors lie side by side, from clouds without fakes.

    train_co_occurrence.py OUT CLOUD...      of publish_cloud with eta 1
"""
import sys

import numpy as np
import torch
from clouds import read_cloud
from network import Network, auc, rounded, write

COMPONENTS = 40
NEAREST, FARTHEST_CHORD = 8, 0.06  # who counts as a neighbour
PAIRS = 60000  # of each kind, over all clouds
EPOCHS = 8


def principal_axes(descriptors):
    mean = descriptors.mean(0)
    _, _, axes = np.linalg.svd(descriptors - mean, full_matrices=False)
    return mean, axes[:COMPONENTS]


def pairs_of(directions, random, count):
    """Indices of neighbours, and of strangers."""
    x = torch.from_numpy(directions)
    a = random.integers(len(x), size=count)
    chord, beside = torch.cdist(x[a], x).topk(NEAREST + 1, largest=False)
    pick = 1 + random.integers(NEAREST, size=count)
    near = chord.numpy()[np.arange(count), pick] < FARTHEST_CHORD
    b = beside.numpy()[np.arange(count), pick]
    return (a[near], b[near]), (a, random.integers(len(x), size=count))


def rows_of(clouds, mean, axes, random):
    rows, labels = [], []
    for directions, descriptors, *_ in clouds:
        components = ((descriptors - mean) @ axes.T).astype(np.float32)
        for label, (a, b) in zip((1, 0), pairs_of(directions, random, PAIRS // len(clouds))):
            a, b = components[a], components[b]
            rows.append(np.concatenate([np.abs(a - b), a * b / 100, a + b], 1))
            labels.append(np.full(len(a), label))
    return np.concatenate(rows), np.concatenate(labels)


def main(out, *paths):
    torch.set_num_threads(1)
    random = np.random.default_rng(1)
    clouds = [read_cloud(path) for path in paths]
    held_out, clouds = clouds[-len(clouds) // 5:], clouds[:-len(clouds) // 5]
    everything = np.concatenate([c[1] for c in clouds]).astype(np.float32)
    mean, axes = principal_axes(everything[random.choice(len(everything), min(20000, len(everything)), replace=False)])
    rows, labels = rows_of(clouds, mean, axes, random)
    print(f"co-occurrence: {len(clouds)} places, {len(rows)} pairs")
    network = Network(rows.shape[1], 1).fit(rows, labels, EPOCHS, print)
    rows, labels = rows_of(held_out, mean, axes, random)
    print(f"  on {len(held_out)} other places: AUC {auc(network.logits(rows), labels == 1):.3f} of pairs")
    write(out, {"format": "spherecloud co-occurrence 1", "mean": rounded(mean), "axes": rounded(axes),
                "network": network.json()})


if __name__ == "__main__":
    main(*sys.argv[1:])
