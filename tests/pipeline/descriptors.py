#!/usr/bin/env python3
"""What coarser descriptors cost a map and what they still tell, through the command line alone; docs/descriptors.md.

    descriptors.py --spherecloud BIN [--ledger FILE]

Builds maps at eta 33 %, replaces their descriptors by what a code of so many bits or bytes would bring back, and measures
localization of other frames, and how well a stranger with 64 keypoints of a picture can tell whether the place is in the map
(share of keypoints that pass the ratio test; AUC against pictures of another place).  Needs numpy and the recordings of
accuracy.py; exits with 77 (skipped) where they are absent.
"""
import argparse
import csv
import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "support"))
import read_map  # noqa: E402

DATA = pathlib.Path(os.environ.get("SPHC_DATA", HERE.parent.parent.parent / "shared" / "data"))
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
    return ["--recording", DATA / spec["folder"], "--calibration", HERE / "calibration" / (place + ".json"),
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


def measure(tool, place, other, folder):
    import numpy
    map_file = folder / "map.sphc"
    run([tool, "build", *source(place, "map"), "--map", map_file, "--eta", ETA, "--fakes", "gaussian", "--key",
         HERE / "test_key.txt", "--json"])
    original = map_file.read_bytes()
    descriptors = numpy.frombuffer(read_map.read(original).descriptors, numpy.uint8).reshape(-1, BYTES)
    for name, (bits, code) in CODES.items():
        rough = code(descriptors).astype(numpy.uint8)
        map_file.write_bytes(with_descriptors(original, rough.tobytes()))
        found = run([tool, "localize", *source(place, "query"), "--map", map_file, "--mode", "single", "--owner-note",
                     str(map_file) + ".owner.json", "--json"])
        present = matched_shares(tool, place, map_file, folder)
        absent = matched_shares(tool, other, map_file, folder)
        distortion = numpy.sqrt(((rough.astype(float) - descriptors) ** 2).sum(1)).mean()
        median = found["translation_error_m"]["median"]
        yield [place, name, bits, "%.1f" % distortion, "%.1f" % found["within_5cm_5deg_percent"],
               "%.1f" % found["localized_percent"], "" if median is None else "%.2f" % (100 * median),
               "%d" % found["median"]["matches"], "%.3f" % auc(present, absent), "%.3f" % numpy.mean(present),
               "%.3f" % numpy.mean(absent)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spherecloud", required=True, help="the command")
    parser.add_argument("--ledger", type=pathlib.Path, help="CSV to write")
    arguments = parser.parse_args()
    if not all((DATA / spec["folder"]).is_dir() for spec in PLACES.values()):
        print("skipped: no recordings at %s; set SPHC_DATA" % DATA)
        sys.exit(77)
    rows = []
    for place, other in (("redkitchen", "hololens"), ("hololens", "redkitchen")):
        with tempfile.TemporaryDirectory() as folder:
            for row in measure(arguments.spherecloud, place, other, pathlib.Path(folder)):
                rows.append(row)
                print(*row, flush=True)
    if arguments.ledger:
        with arguments.ledger.open("w", newline="") as out:
            writer = csv.writer(out, lineterminator="\n")
            writer.writerow(COLUMNS)
            writer.writerows(rows)


if __name__ == "__main__":
    main()
