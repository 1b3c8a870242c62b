#!/usr/bin/env python3
"""Learns to tell real points from the fakes of one strategy.

    train.py OUT STRATEGY FEATURES...      of cloud_features; files of one place must follow each other

The first stage scores a point by its own features; the second also knows the first's scores of the neighbours.  What
the second learns from are scores of places that the first has not seen.
"""
import sys

import numpy as np
import torch
from clouds import read_features
from network import Network, auc, write

FOLDS = 2
EPOCHS = 8


def with_neighbours_scores(values, beside, scores):
    """As withNeighboursScores in ../../attack/real_or_fake.cpp."""
    theirs = scores[beside]
    return np.column_stack([values, scores, theirs[:, :4].mean(1), theirs[:, :16].mean(1), theirs.mean(1),
                            theirs[:, :16].max(1)]).astype(np.float32)


def fit(rows, clouds, seed, log):
    labels = np.concatenate([real for _, _, real in clouds])
    return Network(rows[0].shape[1], seed).fit(np.concatenate(rows), labels, EPOCHS, log)


def silent(_):
    pass


def scores_unseen(clouds):
    """Of each cloud, by a first stage that learned on the others."""
    fold = np.arange(len(clouds)) * FOLDS // len(clouds)
    scores = []
    for k in range(FOLDS):
        known = [cloud for cloud, f in zip(clouds, fold) if f != k]
        network = fit([values for values, _, _ in known], known, k, silent)
        scores += [network.probabilities(cloud[0]) for cloud, f in zip(clouds, fold) if f == k]
    return scores


def learn(clouds, log):
    log(" first stage")
    first = fit([values for values, _, _ in clouds], clouds, 7, log)
    log(" second stage")
    rows = [with_neighbours_scores(values, beside, scores)
            for (values, beside, _), scores in zip(clouds, scores_unseen(clouds))]
    return first, fit(rows, clouds, 8, log)


def main(out, strategy, *paths):
    torch.set_num_threads(1)
    clouds = [read_features(path) for path in paths]
    held_out, clouds = clouds[-len(clouds) // 5:], clouds[:-len(clouds) // 5]
    print(f"{strategy}: {len(clouds)} clouds, {sum(len(c[2]) for c in clouds)} points")
    first, second = learn(clouds, print)
    for what, scores in (
            ("first stage", [first.probabilities(v) for v, _, _ in held_out]),
            ("both", [second.probabilities(with_neighbours_scores(v, b, first.probabilities(v))) for v, b, _ in held_out])):
        figures = [auc(s, real) for s, (_, _, real) in zip(scores, held_out)]
        print(f" {what}, on {len(held_out)} clouds of other places: AUC {np.mean(figures):.3f}"
              f" ({min(figures):.3f} to {max(figures):.3f})")
    write(out, {"format": "spherecloud real-or-fake 1", "strategy": strategy, "first": first.json(),
                "second": second.json()})


if __name__ == "__main__":
    main(*sys.argv[1:])
