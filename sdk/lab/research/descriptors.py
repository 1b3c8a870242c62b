#!/usr/bin/env python3
"""What coarser or keyed descriptors cost a map and what they still tell, through the command line; docs/descriptors.md.

    descriptors.py --spherecloud BIN [--results FILE]

Builds maps at eta 33 %, replaces their descriptors by what a code of so many bits or bytes would bring back, and measures
localization of other frames, and how well a stranger with 64 keypoints of a picture can tell whether the place is in the map
(share of keypoints that pass the ratio test; AUC against pictures of another place).  Needs numpy and the recordings of
accuracy.py; exits with 77 (skipped) where they are absent.
"""
import argparse
import csv
import itertools
import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

ROOT = pathlib.Path(__file__).resolve().parents[3]
PIPELINE = ROOT / "tests" / "pipeline"
sys.path.insert(0, str(ROOT / "tests" / "support"))
sys.path.insert(0, str(PIPELINE))
import read_map  # noqa: E402
from private_key import private_key  # noqa: E402

DATA = pathlib.Path(os.environ.get("SPHC_DATA", ROOT.parent / "shared" / "data"))
ETA, STRANGER_KEYPOINTS, BYTES = 0.33, 64, 128
PLACES = {
    "redkitchen": dict(folder="redkitchen/seq-01", map=(0, 597, 3), query=(620, 799, 6)),
    "hololens": dict(folder="hololens", map=(0, 198, 2), query=(1, 199, 8)),
}
COLUMNS = ["place", "code", "bits_a_point", "distortion", "within_5cm_5deg_percent", "localized_percent", "median_cm",
           "matches", "presence_auc", "matched_present", "matched_absent"]


def run(command):
    result = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if result.returncode not in (0, 3):
        sys.exit("failed: %s\n%s%s" % (" ".join(map(str, command)), result.stdout, result.stderr))
    return json.loads(result.stdout)


def source(place, part):
    spec = PLACES[place]
    first, last, step = spec[part]
    return ["--recording", DATA / spec["folder"], "--calibration", PIPELINE / "calibration" / (place + ".json"),
            "--first", first, "--last", last, "--step", step]


def scalar(descriptors, bits):
    """Each byte by one of 2^bits levels (Lloyd and Max), trained on all bytes."""
    import numpy
    counts = numpy.bincount(descriptors.ravel(), minlength=256).astype(float)
    values = numpy.arange(256)
    levels = numpy.unique(numpy.quantile(descriptors[::7].ravel(), (numpy.arange(2 ** bits) + 0.5) / 2 ** bits))
    levels = numpy.linspace(levels[0], levels[-1], 2 ** bits)
    for _ in range(60):
        nearest = numpy.abs(values[:, None] - levels).argmin(1)
        weights = numpy.bincount(nearest, counts, 2 ** bits)
        sums = numpy.bincount(nearest, counts * values, 2 ** bits)
        levels = numpy.where(weights > 0, sums / numpy.maximum(weights, 1), levels)
    return numpy.rint(levels)[numpy.abs(values[:, None] - levels).argmin(1)][descriptors]


def product(descriptors, code_bytes):
    """A byte for each of `code_bytes` slices (Jegou et al. 2011), 256 words each by k-means on a part of the points."""
    import numpy
    width = BYTES // code_bytes
    rough = numpy.empty(descriptors.shape)
    random = numpy.random.RandomState(1)
    chosen = random.permutation(len(descriptors))[:6000]
    for at in range(0, BYTES, width):
        part = descriptors[:, at:at + width].astype(numpy.float32)
        training = part[chosen]
        words = training[:256].copy()

        def nearest(rows):
            return ((words ** 2).sum(1) - 2 * rows @ words.T).argmin(1)
        for _ in range(8):
            member = nearest(training)
            for k in range(256):
                if (member == k).any():
                    words[k] = training[member == k].mean(0)
        rough[:, at:at + width] = words[nearest(part)]
    return numpy.clip(numpy.rint(rough), 0, 255)


CODES = {
    "8 bits": (1024, lambda d: d),
    "4 bits": (512, lambda d: scalar(d, 4)),
    "3 bits": (384, lambda d: scalar(d, 3)),
    "2 bits": (256, lambda d: scalar(d, 2)),
    "PQ 32 bytes": (256, lambda d: product(d, 32)),
    "PQ 16 bytes": (128, lambda d: product(d, 16)),
}
RATIO = 0.8


def rounded(values):
    import numpy
    return numpy.clip(numpy.rint(values), 0, 255)


class Rotation:
    """A secret orthogonal map of descriptor space, its values stored as bytes about 128."""

    def __init__(self, descriptors):
        import numpy
        self.turn = numpy.linalg.qr(numpy.random.RandomState(7).standard_normal((BYTES, BYTES)))[0]
        self.mean = descriptors.mean(0)
        turned = (descriptors - self.mean) @ self.turn
        self.gain = 127 / numpy.quantile(numpy.abs(turned), 0.9999)
        self.stored = rounded(128 + self.gain * turned)

    def undone(self):
        return rounded(self.mean + (self.stored - 128) / self.gain @ self.turn.T)


UNDONE = {"rotation, undone": (8 * BYTES, lambda d: Rotation(d).undone())}


def permuted(descriptors):
    import numpy
    return descriptors[:, numpy.random.RandomState(7).permutation(BYTES)]


def moments(descriptors):
    centred = descriptors - descriptors.mean(0)
    return centred.T @ centred / len(centred)


def assigned(costs):
    """The stored place of each, the surest first."""
    import numpy
    taken = numpy.full(BYTES, -1)
    for at in numpy.argsort(costs, axis=None):
        place, source = divmod(int(at), BYTES)
        if taken[place] < 0 and source not in taken:
            taken[place] = source
    return taken


def place_by_place(stored, public):
    """Undoes a permutation: each place by the stored one whose mean, deviation and covariances look most alike, then, again
    and again, by the covariances with the others as they were assigned."""
    import numpy

    def looks(descriptors):
        covariances = moments(descriptors)
        return numpy.column_stack([descriptors.mean(0), numpy.sqrt(numpy.diag(covariances)),
                                   numpy.sqrt(numpy.abs(numpy.sort(covariances, 1)))])

    def apart(a, b):
        return (a ** 2).sum(1)[:, None] - 2 * a @ b.T + (b ** 2).sum(1)
    taken = assigned(apart(looks(public), looks(stored)))
    theirs, ours = moments(stored), moments(public)
    for _ in range(40):
        taken = assigned(apart(ours, theirs[:, taken]))
    return stored[:, taken]


def axis_by_axis(stored, public):
    """Undoes a rotation: principal axes onto principal axes, signs by skewness."""
    import numpy

    def axes(descriptors):
        vectors = numpy.linalg.eigh(moments(descriptors))[1]
        along = (descriptors - descriptors.mean(0)) @ vectors
        return vectors * numpy.sign((along ** 3).mean(0)), along.std(0)
    (theirs, their_spread), (ours, our_spread) = axes(stored), axes(public)
    along = (stored - stored.mean(0)) @ theirs / numpy.maximum(their_spread, 1e-9)
    return rounded(public.mean(0) + (along * our_spread) @ ours.T)


# What a stranger sees of what is stored under a key, who has the descriptors of another place.
KEYED = {
    "8 bits": lambda d, public: d,
    "rotation": lambda d, public: Rotation(d).stored,
    "rotation, guessed": lambda d, public: axis_by_axis(Rotation(d).stored, public),
    "permutation": lambda d, public: permuted(d),
    "permutation, guessed": lambda d, public: place_by_place(permuted(d), public),
}


def passing(queries, descriptors):
    """Which queries pass the ratio test in a map, all of it looked at."""
    import numpy
    lengths = (descriptors ** 2).sum(1)
    near = numpy.sort(numpy.partition(lengths - 2 * queries @ descriptors.T, 1)[:, :2], 1) + (queries ** 2).sum(1)[:, None]
    return near[:, 0] < RATIO ** 2 * near[:, 1]


def keyed(tool, place, other, folder):
    """Rows of what a stranger with sets of keypoints tells of a map's membership when he has no key."""
    import numpy
    descriptors = {name: build(tool, name, folder, "map", ETA)[1].astype(numpy.float32) for name in PLACES}
    pictures = {name: build(tool, name, folder, "query", 1)[1].astype(numpy.float32) for name in PLACES}
    for code, seen in KEYED.items():
        found = seen(descriptors[place], descriptors[other]).astype(numpy.float32)
        shares = {name: [passing(some, found).mean() for some in numpy.split(pictures[name][:40 * STRANGER_KEYPOINTS], 40)]
                  for name in PLACES}
        yield [place, code + " (keyed)", 8 * BYTES, "", "", "", "", "", "%.3f" % auc(shares[place], shares[other]),
               "%.3f" % numpy.mean(shares[place]), "%.3f" % numpy.mean(shares[other])]


def with_descriptors(file, descriptors):
    """The same map file with other descriptors; the index stays, which only costs matches where it fits worse."""
    read_map.read(file)
    changed = bytearray(file)
    entry = read_map.HEADER.size + (read_map.DESCRIPTORS - 1) * read_map.SECTION.size
    _, _, offset, size, _, _ = read_map.SECTION.unpack_from(changed, entry)
    changed[offset:offset + size] = descriptors
    struct.pack_into("<I", changed, entry + 24, zlib.crc32(descriptors))
    table_end = read_map.HEADER.size + read_map.SECTIONS * read_map.SECTION.size
    struct.pack_into("<I", changed, 60, zlib.crc32(bytes(changed[:60]) + b"\0\0\0\0" + bytes(changed[64:table_end])))
    read_map.read(bytes(changed))
    return bytes(changed)


def matched_shares(tool, place, map_file, folder):
    """Of the strongest keypoints of a place's frames, the share that passes the ratio test in the map."""
    frames = folder / "frames.jsonl"
    run([tool, "localize", *source(place, "query"), "--map", map_file, "--mode", "single", "--max-keypoints",
         STRANGER_KEYPOINTS, "--frames-json", frames, "--json"])
    rows = [json.loads(line) for line in frames.read_text().splitlines()]
    return [row["matches"] / max(row["keypoints"], 1) for row in rows]


def auc(present, absent):
    wins = sum((p > a) + 0.5 * (p == a) for p in present for a in absent)
    return wins / (len(present) * len(absent))


def build(tool, place, folder, part, eta):
    """The map file, and its descriptors."""
    import numpy
    stem = folder / ("%s_%s" % (place, part))
    map_file = stem.with_suffix(".sphc")
    if not map_file.exists():
        run([tool, "build", *source(place, part), "--map", map_file, "--ledger", stem.with_suffix(".ledger"), "--eta", eta,
             "--fakes", "gaussian", "--key", private_key(folder), "--json"])
    stored = read_map.read(map_file.read_bytes()).descriptors
    return map_file, numpy.frombuffer(stored, numpy.uint8).reshape(-1, BYTES)


def measure(tool, place, other, folder):
    import numpy
    map_file, descriptors = build(tool, place, folder, "map", ETA)
    original, coded = map_file.read_bytes(), folder / "coded.sphc"
    for name, (bits, code) in {**CODES, **UNDONE}.items():
        rough = code(descriptors).astype(numpy.uint8)
        coded.write_bytes(with_descriptors(original, rough.tobytes()))
        found = run([tool, "localize", *source(place, "query"), "--map", coded, "--mode", "single", "--owner-note",
                     str(map_file) + ".owner.json", "--json"])
        present = matched_shares(tool, place, coded, folder)
        absent = matched_shares(tool, other, coded, folder)
        distortion = numpy.sqrt(((rough.astype(float) - descriptors) ** 2).sum(1)).mean()
        median = found["translation_error_m"]["median"]
        yield [place, name, bits, "%.1f" % distortion, "%.1f" % found["within_5cm_5deg_percent"],
               "%.1f" % found["localized_percent"], "" if median is None else "%.2f" % (100 * median),
               "%d" % found["median"]["matches"], "%.3f" % auc(present, absent), "%.3f" % numpy.mean(present),
               "%.3f" % numpy.mean(absent)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spherecloud", required=True, help="the command")
    parser.add_argument("--results", type=pathlib.Path, help="CSV to write")
    arguments = parser.parse_args()
    if not all((DATA / spec["folder"]).is_dir() for spec in PLACES.values()):
        print("skipped: no recordings at %s; set SPHC_DATA" % DATA)
        sys.exit(77)
    rows = []
    for place, other in (("redkitchen", "hololens"), ("hololens", "redkitchen")):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            for row in itertools.chain(measure(arguments.spherecloud, place, other, folder),
                                       keyed(arguments.spherecloud, place, other, folder)):
                rows.append(row)
                print(*row, flush=True)
    if arguments.results:
        with arguments.results.open("w", newline="") as out:
            writer = csv.writer(out, lineterminator="\n")
            writer.writerow(COLUMNS)
            writer.writerows(rows)


if __name__ == "__main__":
    main()
