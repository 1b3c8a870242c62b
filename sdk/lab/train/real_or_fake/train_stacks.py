#!/usr/bin/env python3
"""Learns to tell the real layer of stacks from the fakes on top of it.

    train_stacks.py OUT STRATEGY CLOUD,STACKS... [--minutes M] [--start FILE.pt] [--golden CSV]    of publish_cloud and cloud_stacks

Clouds of one place must follow each other; the last fifth is held out.  OUT.pt keeps what a further training starts from.
"""
import argparse
import time

import numpy as np
import torch
from clouds import read_cloud, read_stacks
from network import auc, write
from stack_network import MOST_POINTS, StackNetwork, golden

SETS, STEPS, RATE, DECAY = 24, 1800, 2e-3, .02
OF_LAYERS = .5  # weight of the loss of pairs
FEWEST = 10  # points in a stack that is learned from


class Cloud:
    def __init__(self, paths):
        cloud, stacks = paths.split(",")
        self.directions, self.descriptors, self.real, self.patches = read_cloud(cloud)
        labels, self.told = read_stacks(stacks)
        order = np.argsort(labels, kind="stable")
        self.stacks = np.split(order, np.flatnonzero(np.diff(labels[order])) + 1)

    def parts(self):
        """As StackClassifier::logits: large stacks in parts."""
        for stack in self.stacks:
            count = -(-len(stack) // MOST_POINTS)
            for part in range(count):
                yield stack[part::count]


def batch(sets):
    """Tensors of sets of points of clouds, padded."""
    shape = len(sets), max(len(points) for _, points in sets)
    directions, descriptors = np.zeros((*shape, 3), np.float32), np.zeros((*shape, 128), np.float32)
    told = np.zeros((*shape, sets[0][0].told.shape[1]), np.float32)
    present, real = np.zeros(shape, bool), np.zeros(shape, np.float32)
    patches = np.full(shape, -1)
    for i, (cloud, points) in enumerate(sets):
        n = len(points)
        directions[i, :n], descriptors[i, :n], told[i, :n] = (
            cloud.directions[points], cloud.descriptors[points], cloud.told[points])
        present[i, :n], real[i, :n], patches[i, :n] = True, cloud.real[points], cloud.patches[points]
    return [torch.from_numpy(a) for a in (directions, descriptors, told, present, real, patches)]


def learn(network, clouds, minutes, log):
    random = np.random.default_rng(1)
    stacks = [(cloud, stack) for cloud in clouds for stack in cloud.stacks if len(stack) >= FEWEST]
    chance = np.array([min(len(stack), MOST_POINTS) for _, stack in stacks], float)
    chance /= chance.sum()
    optimizer = torch.optim.AdamW(network.parameters(), lr=RATE, weight_decay=DECAY)
    begin, told, losses, done = time.time(), 0, [], 0.
    cross_entropy = torch.nn.functional.binary_cross_entropy_with_logits
    for step in range(STEPS):
        # By time too: a slow machine learns less, and still ends with a small rate.
        done = max(step / STEPS, (time.time() - begin) / (60 * minutes))
        if done >= 1:
            break
        for group in optimizer.param_groups:
            group["lr"] = RATE * min(1, (step + 1) / 100) * .5 * (1 + np.cos(np.pi * done))
        chosen = [stacks[i] for i in random.choice(len(stacks), SETS, p=chance)]
        chosen = [(cloud, random.permutation(stack)[:MOST_POINTS]) for cloud, stack in chosen]
        *points, real, patches = batch(chosen)
        present = points[-1]
        logits, pairs = network(*points)
        both = present[:, :, None] & present[:, None]
        same = (patches[:, :, None] == patches[:, None]).float()
        of_points = cross_entropy(logits[present], real[present])
        of_layers = cross_entropy(pairs[both], same[both])
        optimizer.zero_grad()
        (of_points + OF_LAYERS * of_layers).backward()
        torch.nn.utils.clip_grad_norm_(network.parameters(), 1.)
        optimizer.step()
        losses.append((of_points.item(), of_layers.item()))
        if (step + 1) % 200 == 0:
            log(f"  step {step + 1}: loss {np.mean(losses[told:], 0)[0]:.4f}, of pairs {np.mean(losses[told:], 0)[1]:.4f}")
            told = step + 1
    log(f"  {len(losses)} steps, {time.time() - begin:.0f} s")


@torch.no_grad()
def logits_of(network, cloud):
    logits, parts = np.zeros(len(cloud.real)), list(cloud.parts())
    for k in range(0, len(parts), SETS):
        some = parts[k:k + SETS]
        *points, _, _ = batch([(cloud, part) for part in some])
        found = network(*points)[0].numpy()
        for row, part in zip(found, some):
            logits[part] = row[:len(part)]
    return logits


def by_layer(scores, patches):
    """Each point's score is the mean of its layer's: an oracle has separated them."""
    return (np.bincount(patches, scores) / np.maximum(np.bincount(patches), 1))[patches]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out")
    parser.add_argument("strategy")
    parser.add_argument("clouds", nargs="+")
    parser.add_argument("--minutes", type=float, default=30)
    parser.add_argument("--start")
    parser.add_argument("--golden", help="what the test of the attack's own code expects of it")
    options = parser.parse_args()
    torch.set_num_threads(1)
    torch.manual_seed(1)
    clouds = [Cloud(paths) for paths in options.clouds]
    held_out, clouds = clouds[-len(clouds) // 5:], clouds[:-len(clouds) // 5]
    print(f"stacks of {options.strategy}: {len(clouds)} clouds, {sum(len(c.real) for c in clouds)} points", flush=True)
    told = np.concatenate([cloud.told for cloud in clouds])
    network = StackNetwork(told.mean(0), 1 / (told.std(0) + 1e-6))
    if options.start:
        network.load_state_dict(torch.load(options.start))
    learn(network, clouds, options.minutes, lambda line: print(line, flush=True))
    torch.save(network.state_dict(), options.out + ".pt")
    network.quantise()
    found = [(logits_of(network, cloud), cloud) for cloud in held_out]
    points = [auc(scores, cloud.real) for scores, cloud in found]
    layers = [auc(by_layer(scores, cloud.patches), cloud.real) for scores, cloud in found]
    print(f"  on {len(held_out)} clouds of other places: AUC {np.mean(points):.3f} ({min(points):.3f} to"
          f" {max(points):.3f}), of layers {np.mean(layers):.3f} ({min(layers):.3f} to {max(layers):.3f})")
    write(options.out, {"format": "spherecloud stacks 1", "strategy": options.strategy, **network.json()})
    if options.golden:
        np.savetxt(options.golden, golden(network), "%.6f")


if __name__ == "__main__":
    main()
