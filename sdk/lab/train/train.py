#!/usr/bin/env python3
"""Trains the inverter.

    train.py OUT.pt SET... [--clean | --patchwork] [--steps N] [--start FILE.pt] [--seed N]

SET is a folder that make_set.py wrote.  Sources whose number is divisible by 12 are kept aside for validation.
Without --clean six samples of ten are mixed with fakes; with --patchwork by the project's own strategy.  One thread, the same seed gives the same network on the same
machine; the log goes to stdout.
"""
import argparse
import os
import time

import numpy as np
import torch
from mixture import MIRROR, inside, mix, patchwork
from network import GRID, Embedding, Painter, cells, paint
from view import SIDE

BATCH = 8
RATE = 2e-3
VALIDATE_EVERY = 250


class Samples:
    def __init__(self, folders, by_patchwork):
        self.by_patchwork = by_patchwork
        sets = [np.load(os.path.join(folder, "set.npz")) for folder in folders]
        self.truth = np.concatenate([s["truth"] for s in sets])
        sources, offset = [], 0
        for s in sets:
            sources.append(s["source"] + offset)
            offset += len(s["name"])
        self.source = np.concatenate(sources)
        self.pixel, self.descriptor = [], []
        for s in sets:
            pixel, descriptor, begin = s["pixel"].astype(np.float32), s["descriptor"], s["begin"]
            self.pixel += [pixel[a:b] for a, b in zip(begin, begin[1:])]
            self.descriptor += [descriptor[a:b] for a, b in zip(begin, begin[1:])]
        aside = self.source % 12 == 0
        begin = np.cumsum([0] + [len(s["truth"]) for s in sets])
        self.train = [a + np.flatnonzero(~aside[a:b]) for a, b in zip(begin, begin[1:])]
        self.validation = np.flatnonzero(aside)

    def choose(self, random, count):
        """Each set as often as the others, whatever its size."""
        return [random.choice(self.train[random.integers(len(self.train))]) for _ in range(count)]

    def draw(self, random, index, with_fakes):
        friends = np.flatnonzero(self.source == self.source[index])
        other = friends[random.integers(len(friends))]
        if other == index:  # a source of one view: borrow from a stranger
            other = random.integers(len(self.truth))
        points = self.pixel[index], self.descriptor[index], self.pixel[other], self.descriptor[other]
        if with_fakes and self.by_patchwork:
            pixel, descriptor = patchwork(random, *points)
        else:
            pixel, descriptor = mix(random, *points, with_fakes)
        truth = self.truth[index]
        if random.random() < .5:
            pixel, truth = np.stack([SIDE - pixel[:, 0], pixel[:, 1]], 1), truth[:, ::-1]
            descriptor = descriptor[:, MIRROR]
        seen = inside(pixel)
        return truth, pixel[seen], descriptor[seen]


def batch(samples, random, indices, clean_share):
    """Standardised truths, and of all keypoints what paint() wants."""
    truths, everywhere, keypoints = [], [], []
    for number, index in enumerate(indices):
        truth, pixel, descriptor = samples.draw(random, index, random.random() >= clean_share)
        truth = truth.astype(np.float32)
        truths.append((truth - truth.mean()) / max(truth.std(), 1))
        cell, offset = cells(pixel)
        everywhere.append(number * GRID * GRID + cell)
        keypoints.append(np.concatenate([descriptor.astype(np.float32) / 128, offset], 1))
    keypoints = torch.from_numpy(np.concatenate(keypoints).astype(np.float32))
    return (torch.from_numpy(np.stack(truths))[:, None], keypoints, torch.ones(len(keypoints)),
            torch.from_numpy(np.concatenate(everywhere)))


def loss_of(image, truth):
    across = (image.diff(dim=3) - truth.diff(dim=3)).abs().mean()
    along = (image.diff(dim=2) - truth.diff(dim=2)).abs().mean()
    return (image - truth).abs().mean() + .5 * (across + along)


def correlation(image, truth):
    def centred(x):
        x = x.flatten(1)
        x = x - x.mean(1, keepdim=True)
        return x / x.norm(dim=1, keepdim=True).clamp(min=1e-6)
    return (centred(image) * centred(truth)).sum(1)


def validate(samples, embedding, painter):
    """Correlation without fakes and with them, over the sources kept aside."""
    embedding.eval(), painter.eval()
    scores = []
    with torch.no_grad():
        for clean_share in (1, 0):
            random, found = np.random.Generator(np.random.PCG64(7)), []
            chosen = samples.validation[::max(1, len(samples.validation) // 64)]
            for at in range(0, len(chosen), BATCH):
                truth, *points = batch(samples, random, chosen[at:at + BATCH], clean_share)
                found.append(correlation(paint(embedding, painter, *points, len(truth)), truth))
            scores.append(float(torch.cat(found).mean()))
    embedding.train(), painter.train()
    return scores


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out")
    parser.add_argument("sets", nargs="+")
    parser.add_argument("--clean", action="store_true")
    parser.add_argument("--patchwork", action="store_true")
    parser.add_argument("--steps", type=int, default=1800)
    parser.add_argument("--start")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    torch.set_num_threads(1)
    torch.manual_seed(options.seed)
    random = np.random.Generator(np.random.PCG64(options.seed))
    samples, embedding, painter = Samples(options.sets, options.patchwork), Embedding(), Painter()
    if options.start:
        state = torch.load(options.start)
        embedding.load_state_dict(state["embedding"]), painter.load_state_dict(state["painter"])
    parameters = [*embedding.parameters(), *painter.parameters()]
    optimiser = torch.optim.AdamW(parameters, RATE, weight_decay=1e-4)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimiser, RATE, options.steps, pct_start=.1)
    print(f"{sum(map(len, samples.train))} samples, {len(samples.validation)} aside, "
          f"{sum(p.numel() for p in parameters)} parameters", flush=True)
    clean_share, mean, begin = 1 if options.clean else .4, 0, time.process_time()
    for step in range(1, options.steps + 1):
        truth, *points = batch(samples, random, samples.choose(random, BATCH), clean_share)
        loss = loss_of(paint(embedding, painter, *points, BATCH), truth)
        optimiser.zero_grad()
        loss.backward()
        optimiser.step()
        schedule.step()
        mean += (float(loss) - mean) / min(step, VALIDATE_EVERY)
        if step % VALIDATE_EVERY == 0 or step == options.steps:
            clean, mixed = validate(samples, embedding, painter)
            print(f"step {step}: loss {mean:.3f}, correlation aside {clean:.3f} without fakes, {mixed:.3f} with, "
                  f"{time.process_time() - begin:.0f} CPU s", flush=True)
            torch.save({"embedding": embedding.state_dict(), "painter": painter.state_dict()}, options.out)


if __name__ == "__main__":
    main()
