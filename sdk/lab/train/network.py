"""The network: each keypoint's descriptor and place in its cell become 24 numbers, their mean in each cell of a grid a
picture of 25 planes, and a small U-Net paints a grey image of it.  Two parts, since the mean is no operation of a
portable network."""
import torch
from torch import nn
from view import SIDE

GRID = SIDE // 2  # cells, both ways
INPUT = 130       # descriptor bytes divided by 128, then x and y in the cell, -0.5 to 0.5
EMBEDDED = 24
PLANES = EMBEDDED + 1  # and how many keypoints a cell holds


class Embedding(nn.Module):
    """N x INPUT to N x EMBEDDED."""

    def __init__(self):
        super().__init__()
        self.layers = nn.Sequential(nn.Linear(INPUT, 96), nn.ReLU(), nn.Linear(96, EMBEDDED))

    def forward(self, keypoints):
        return self.layers(keypoints)


def _block(inside, outside, stride=1):
    return nn.Sequential(nn.Conv2d(inside, outside, 3, stride, 1), nn.BatchNorm2d(outside), nn.ReLU(inplace=True))


class Painter(nn.Module):
    """Planes (B x PLANES x GRID x GRID) to the four pixels of each cell, rows first (B x 4 x GRID x GRID); about of
    mean 0 and deviation 1."""

    def __init__(self, widths=(32, 64, 96, 128)):
        super().__init__()
        self.first = _block(PLANES, widths[0])
        self.down = nn.ModuleList(nn.Sequential(_block(a, b, 2), _block(b, b)) for a, b in zip(widths, widths[1:]))
        self.bottom = nn.Sequential(_block(widths[-1], widths[-1], 2), _block(widths[-1], widths[-1]))
        steps = list(zip((widths[-1],) + widths[:0:-1], widths[::-1]))
        self.up = nn.ModuleList(_block(below + beside, beside) for below, beside in steps)
        self.grow = nn.Upsample(scale_factor=2, mode="nearest")
        self.last = nn.Conv2d(widths[0], 4, 3, 1, 1)

    def forward(self, planes):
        x = self.first(planes)
        beside = [x]
        for down in self.down:
            x = down(x)
            beside.append(x)
        x = self.bottom(x)
        for up in self.up:
            x = up(torch.cat([self.grow(x), beside.pop()], 1))
        return self.last(x)


def cells(pixel):
    """Cell numbers of keypoints within one picture, and where in the cell they are."""
    place = pixel / 2
    cell = place.astype(int)
    return cell[:, 1] * GRID + cell[:, 0], place - cell - .5


def planes(embedded, weight, cell, batch):
    """The weighted mean of `embedded` in each of batch * GRID * GRID cells, and a saturating count."""
    total = batch * GRID * GRID
    count = torch.zeros(total).index_add_(0, cell, weight)
    mean = torch.zeros(total, EMBEDDED).index_add_(0, cell, embedded * weight[:, None])
    mean = mean / count.clamp(min=1e-6)[:, None]
    stacked = torch.cat([mean, (count / (count + 1))[:, None]], 1)
    return stacked.reshape(batch, GRID, GRID, PLANES).permute(0, 3, 1, 2)


def paint(embedding, painter, keypoints, weight, cell, batch):
    """Grey images, batch x 1 x SIDE x SIDE."""
    return nn.functional.pixel_shuffle(painter(planes(embedding(keypoints), weight, cell, batch)), 2)
