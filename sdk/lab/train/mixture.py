"""What a published map does to the points of a view: some are gone, some are where they do not belong."""
import numpy as np
from view import SIDE

MIRROR = np.arange(128).reshape(4, 4, 8)[::-1][:, :, (-np.arange(8)) % 8].reshape(-1)  # of a mirrored image


def _spread(random, count, pixel):
    """Anywhere, as under a wide Gaussian on the sphere: flat or in a broad heap around the real ones."""
    if random.random() < .5:
        return random.uniform(0, SIDE, (count, 2))
    return pixel[random.integers(len(pixel), size=count)] + random.normal(0, SIDE * random.uniform(.1, .5), (count, 2))


def _jittered(random, count, pixel):
    """At places of real points, exactly or a little beside."""
    return pixel[random.integers(len(pixel), size=count)] + random.normal(0, random.uniform(0, 6), (count, 2))


def _rigid(random, count, pixel, other):
    """Discarded points of elsewhere in patches of about 20, moved as a whole."""
    placed, chosen = [], []
    while sum(map(len, chosen)) < count:
        middle = other[random.integers(len(other))]
        patch = np.argsort(((other - middle) ** 2).sum(1))[:random.integers(8, 40)]
        target = pixel[random.integers(len(pixel))] + random.normal(0, 4, 2)
        angle = random.uniform(-np.pi, np.pi) if random.random() < .5 else 0
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        placed.append((other[patch] - middle) @ turn.T + target)
        chosen.append(patch)
    return np.concatenate(placed)[:count], np.concatenate(chosen)[:count]


def mix(random, pixel, descriptor, other_pixel, other_descriptor, with_fakes):
    """Pixels and descriptors as an attacker may meet them; `other` is another view of the same place."""
    keep = np.flatnonzero(random.random(len(pixel)) < random.uniform(.2, 1))
    pixel, descriptor = pixel[keep], descriptor[keep]
    pixel = pixel + random.normal(0, random.uniform(0, .6), pixel.shape)
    if not with_fakes or len(pixel) < 2:
        return pixel, descriptor
    share = random.uniform(0, .7)
    count = min(int(len(pixel) * share / (1 - share)), 2 * len(other_pixel))
    chosen = random.integers(len(other_pixel), size=count)
    kind = random.integers(4)
    if kind == 0:
        places = _spread(random, count, pixel)
    elif kind == 1:
        places = _jittered(random, count, pixel)
    elif kind == 2 and count:
        places, chosen = _rigid(random, count, pixel, other_pixel)
    else:  # each at the place of another: the place is real, the look is not
        places = other_pixel[random.integers(len(other_pixel), size=count)]
    return np.concatenate([pixel, places]), np.concatenate([descriptor, other_descriptor[chosen]])


def _cells(random, pixel, width):
    """Indices of the points of each patch, `width` pixels wide."""
    count = max(2, int((SIDE / width) ** 2))
    seed = random.uniform(0, SIDE, (count, 2))
    nearest = ((pixel[:, None] - seed[None]) ** 2).sum(2).argmin(1)
    return [patch for patch in (np.flatnonzero(nearest == k) for k in range(count)) if len(patch)]


def patchwork(random, pixel, descriptor, other_pixel, other_descriptor):
    """The project's own fakes: a third of the patches stay, others lie on them in mirror image, turned."""
    width = random.uniform(9, 32)
    stay = [patch for patch in _cells(random, pixel, width) if random.random() < 1 / 3]
    if not stay or len(other_pixel) < 2:
        return pixel, descriptor
    guests = _cells(random, other_pixel, width)
    pixels = [pixel[patch] for patch in stay]
    descriptors = [descriptor[patch] for patch in stay]
    for patch in stay:
        for _ in range(2):
            guest = guests[random.integers(len(guests))]
            angle = random.uniform(-np.pi, np.pi)
            turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
            laid = (other_pixel[guest] - other_pixel[guest].mean(0)) * [-1, 1] @ turn.T
            pixels.append(laid + pixel[patch].mean(0))
            descriptors.append(other_descriptor[guest][:, MIRROR])
    return np.concatenate(pixels), np.concatenate(descriptors)


def inside(pixel):
    return ((pixel >= 0) & (pixel < SIDE)).all(1)
