"""Poses of a recording as a headset that is a little wrong would tell them.

Off by 5 cm and 1 deg (1 sigma along each axis, every pose by itself): "approximate".  Or summed up along the way from
steps that are 1 % too long and turned by 1 deg, 1 sigma, after a metre: "odometry".
"""
import math
import random

SIGMA_M, SIGMA_DEG = 0.05, 1.0
DRIFT, DRIFT_DEG = 0.01, 1.0


def product(a, b):
    """Of unit quaternions, w x y z."""
    return (a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3], a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
            a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1], a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0])


def inverse(q):
    return (q[0], -q[1], -q[2], -q[3])


def turned(q, v):
    return product(product(q, (0, *v)), inverse(q))[1:]


def random_turn(source, sigma_deg):
    vector = [math.radians(source.gauss(0, sigma_deg)) for _ in range(3)]
    angle = math.hypot(*vector)
    return (math.cos(angle / 2), *(math.sin(angle / 2) / angle * x for x in vector)) if angle else (1.0, 0.0, 0.0, 0.0)


def quaternion(r):
    """Of a rotation matrix; the largest component is divided by (Shepperd 1978)."""
    squares = [1 + r[0][0] + r[1][1] + r[2][2], 1 + r[0][0] - r[1][1] - r[2][2], 1 - r[0][0] + r[1][1] - r[2][2],
               1 - r[0][0] - r[1][1] + r[2][2]]
    k = squares.index(max(squares))
    twice = math.sqrt(squares[k])
    a, b, c = r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]
    d, e, f = r[0][1] + r[1][0], r[0][2] + r[2][0], r[1][2] + r[2][1]
    return tuple(x / (2 * twice) for x in ((squares[0], a, b, c), (a, squares[1], d, e), (b, d, squares[2], f), (c, e, f, squares[3]))[k])


def read(folder):
    """(seconds, place, quaternion) of each pose of a recording in either layout."""
    truth = folder / "groundtruth.txt"
    if truth.exists():
        for line in truth.read_text().splitlines():
            if line.strip() and not line.startswith("#"):
                time, x, y, z, qx, qy, qz, qw = line.split()
                yield time, (float(x), float(y), float(z)), (float(qw), float(qx), float(qy), float(qz))
        return
    for path in sorted(folder.glob("frame-*.pose.txt")):
        rows = [[float(word) for word in line.split()] for line in path.read_text().splitlines() if line.strip()]
        nanoseconds = (int(path.name[6:12]) * 10**9 + 15) // 30
        yield "%d.%09d" % divmod(nanoseconds, 10**9), tuple(row[3] for row in rows[:3]), quaternion(rows)


def approximate(poses, source):
    for time, place, turn in poses:
        yield time, tuple(x + source.gauss(0, SIGMA_M) for x in place), product(turn, random_turn(source, SIGMA_DEG))


def odometry(poses, source):
    before = now = None
    for time, place, turn in poses:
        if before:
            step = turned(inverse(before[1]), [a - b for a, b in zip(place, before[0])])
            way_m = math.hypot(*step)
            moved = turned(now[1], [(1 + DRIFT) * x for x in step])
            change = product(product(inverse(before[1]), turn), random_turn(source, DRIFT_DEG * math.sqrt(way_m)))
            now = tuple(a + b for a, b in zip(now[0], moved)), product(now[1], change)
        else:
            now = place, turn
        before = place, turn
        yield time, *now


def write(kind, folder, out):
    disturb = {"approximate": approximate, "odometry": odometry}[kind]
    with out.open("w") as file:
        for time, place, turn in disturb(read(folder), random.Random(1)):
            file.write("%s %.9f %.9f %.9f %.9f %.9f %.9f %.9f\n" % (time, *place, *turn[1:], turn[0]))
