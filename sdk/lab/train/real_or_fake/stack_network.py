"""A small transformer over the points of one stack.  As ../../../host/audit/attack/stack_classifier.cpp."""
import numpy as np
import torch
from network import FARTHEST, rounded
from torch import nn

MIDDLE, UNIT, REACHES = 40, 0.07, (0.05, 0.15, 0.4, 1)
WIDTH, BLOCKS, HEADS, LOOKS = 48, 3, 4, 64
MOST_POINTS = 128


class Norm(nn.LayerNorm):
    def json(self):
        return {"gain": rounded(self.weight.detach().numpy()), "bias": rounded(self.bias.detach().numpy())}


class Linear(nn.Linear):
    def scale(self):
        """For each output; its largest weight is 127."""
        return np.abs(self.weight.detach().numpy()).max(1).clip(1e-9) / 127

    def eight_bits(self):
        return np.round(self.weight.detach().numpy() / self.scale()[:, None]).astype(int)

    def json(self):
        return {"scale": rounded(self.scale()), "weights": self.eight_bits().tolist(),
                "bias": rounded(self.bias.detach().numpy())}


class Block(nn.Module):
    def __init__(self):
        super().__init__()
        self.before_attention, self.before_change = Norm(WIDTH), Norm(WIDTH)
        self.queries_keys_values, self.mix = Linear(WIDTH, 3 * WIDTH), Linear(WIDTH, WIDTH)
        self.of_distance = Linear(2 + len(REACHES), HEADS)
        self.widen, self.narrow = Linear(WIDTH, 2 * WIDTH), Linear(2 * WIDTH, WIDTH)

    def forward(self, x, closeness, absent):
        sets, count, _ = x.shape
        q, k, v = self.queries_keys_values(self.before_attention(x)).view(sets, count, 3, HEADS, -1).permute(2, 0, 3, 1, 4)
        weights = q @ k.transpose(2, 3) / q.shape[-1] ** .5 + self.of_distance(closeness).permute(0, 3, 1, 2) + absent
        x = x + self.mix((weights.softmax(3) @ v).transpose(1, 2).reshape(x.shape))
        return x + self.narrow(torch.relu(self.widen(self.before_change(x))))

    def json(self):
        return {name: child.json() for name, child in self.named_children()}


class StackNetwork(nn.Module):
    def __init__(self, mean, scale):
        super().__init__()
        self.register_buffer("mean", torch.from_numpy(mean.astype(np.float32)))
        self.register_buffer("scale", torch.from_numpy(scale.astype(np.float32)))
        self.looks_first, self.looks_second = Linear(128, LOOKS), Linear(LOOKS, WIDTH)
        self.told = Linear(len(mean), WIDTH)
        self.blocks = nn.ModuleList(Block() for _ in range(BLOCKS))
        self.last, self.logit = Norm(WIDTH), Linear(WIDTH, 1)
        # To learn by alone: which points are of one layer.
        self.layer, self.layer_scale = nn.Linear(WIDTH, 16), nn.Parameter(torch.tensor([1., -1.]))

    def forward(self, directions, descriptors, told, present):
        """(logits, logits of pairs: of one layer?) of sets of points"""
        apart = torch.cdist(directions, directions) / UNIT
        closeness = torch.stack([(apart + .02).log(), apart] + [(-(apart / reach) ** 2).exp() for reach in REACHES], 3)
        absent = torch.zeros(present.shape).masked_fill(~present, -1e4)[:, None, None]
        told = ((told - self.mean) * self.scale).clamp(-FARTHEST, FARTHEST)
        x = self.looks_second(torch.relu(self.looks_first((descriptors - MIDDLE) / MIDDLE))) + self.told(told)
        for block in self.blocks:
            x = block(x, closeness, absent)
        x = self.last(x)
        layer = self.layer(x)
        return self.logit(x)[..., 0], self.layer_scale[0] * (layer @ layer.transpose(1, 2)) + self.layer_scale[1]

    def quantise(self):
        """What is measured is what is written."""
        for module in self.modules():
            if isinstance(module, Linear):
                module.weight.data = torch.from_numpy((module.eight_bits() * module.scale()[:, None]).astype(np.float32))
        return self

    def json(self):
        model = {"mean": rounded(self.mean.numpy()), "scale": rounded(self.scale.numpy())}
        for name in ("looks_first", "looks_second", "told", "last", "logit"):
            model[name] = getattr(self, name).json()
        return {**model, "blocks": [block.json() for block in self.blocks]}


def golden(network):
    """Logits of 40 points that a test can make as well."""
    i = np.arange(40)
    directions = np.stack([i * 37 % 40 / 400, i * 11 % 40 / 400, np.ones(40)], 1)
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    descriptors = (i[:, None] * 7 + np.arange(128) * 13) % 120
    told = (i[:, None] * 5 + np.arange(len(network.mean)) * 3) % 17 / 4
    sets = [torch.from_numpy(a.astype(np.float32))[None] for a in (directions, descriptors, told)]
    with torch.no_grad():
        return network(*sets, torch.ones(1, 40, dtype=torch.bool))[0][0].numpy()
