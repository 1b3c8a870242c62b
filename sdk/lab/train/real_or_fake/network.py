"""A small network: standardised inputs, clipped, layers with rectifiers between them, a logit.  As ../../attack/mlp.cpp."""
import json
import math

import numpy as np
import torch

FARTHEST = 5  # deviations from the mean
HIDDEN = (64, 32)
BATCH = 1024
RATE, DECAY = 3e-3, 1e-4


class Network:
    def __init__(self, inputs, seed):
        torch.manual_seed(seed)
        sizes = (inputs, *HIDDEN, 1)
        self.layers = [torch.nn.Linear(a, b) for a, b in zip(sizes, sizes[1:])]

    def _logits(self, x):
        for layer in self.layers[:-1]:
            x = torch.relu(layer(x))
        return self.layers[-1](x)[:, 0]

    def _standard(self, rows):
        return torch.from_numpy(np.clip((rows - self.mean) * self.scale, -FARTHEST, FARTHEST).astype(np.float32))

    def fit(self, rows, labels, epochs, log):
        self.mean, self.scale = rows.mean(0), 1 / (rows.std(0) + 1e-6)
        x, y = self._standard(rows), torch.from_numpy(labels.astype(np.float32))
        steps = math.ceil(len(x) / BATCH) * epochs
        optimizer = torch.optim.AdamW([p for l in self.layers for p in l.parameters()], lr=RATE, weight_decay=DECAY)
        schedule = torch.optim.lr_scheduler.CosineAnnealingLR(optimizer, steps)
        for epoch in range(epochs):
            total = 0
            for chosen in torch.randperm(len(x)).split(BATCH):
                loss = torch.nn.functional.binary_cross_entropy_with_logits(self._logits(x[chosen]), y[chosen])
                optimizer.zero_grad()
                loss.backward()
                optimizer.step()
                schedule.step()
                total += loss.item() * len(chosen)
            log(f"  epoch {epoch + 1:2}: loss {total / len(x):.4f}")
        return self

    def logits(self, rows):
        with torch.no_grad():
            return self._logits(self._standard(rows)).numpy()

    def probabilities(self, rows):
        return 1 / (1 + np.exp(-self.logits(rows)))

    def json(self):
        return {"mean": rounded(self.mean), "scale": rounded(self.scale),
                "layers": [{"weights": rounded(l.weight.detach().numpy()), "bias": rounded(l.bias.detach().numpy())}
                           for l in self.layers]}


def rounded(array):
    """Lists of numbers with 5 digits."""
    if array.ndim == 1:
        return [float(f"{x:.5g}") for x in array]
    return [rounded(row) for row in array]


def write(path, model):
    with open(path, "w", encoding="utf-8") as out:
        json.dump(model, out, separators=(",", ":"))
        out.write("\n")


def auc(scores, real):
    """As score/auc.cpp, ties aside."""
    order = np.argsort(scores, kind="stable")
    ranks = np.empty(len(scores))
    ranks[order] = np.arange(1, len(scores) + 1)
    positives = real.sum()
    return (ranks[real].sum() - positives * (positives + 1) / 2) / (positives * (len(real) - positives))
