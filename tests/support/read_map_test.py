#!/usr/bin/env python3
"""Do the C++ and the Python reader agree?  read_map_test.py DUMP_MAP MAKE_MAP FOLDER"""
import math
import os
import random
import subprocess
import sys
import zlib

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.dont_write_bytecode = True
import read_map  # noqa: E402

DUMP, MAKE, FOLDER = sys.argv[1:4]


def dump(path):
    """What the C++ reader says: status, fields, directions."""
    lines = subprocess.run([DUMP, path], check=True, capture_output=True, text=True).stdout.splitlines()
    fields = dict(line.split(" ", 1) for line in lines if not line.startswith("direction"))
    directions = [tuple(map(float, line.split()[1:])) for line in lines if line.startswith("direction")]
    return fields, directions


def agree(path, file):
    fields, directions = dump(path)
    try:
        cloud = read_map.read(file, extractor=2)
    except read_map.MapError as error:
        assert fields["status"] == error.status, f"C++ {fields['status']}, Python {error}"
        return False
    assert fields["status"] == "SPHC_OK", f"C++ {fields['status']}, Python accepts"
    assert int(fields["points"]) == len(cloud.directions)
    assert read_map.BANDS[int(fields["band"])] == cloud.band
    assert int(fields["descriptor_crc"], 16) == zlib.crc32(cloud.descriptors)
    assert int(fields["centroid_crc"], 16) == zlib.crc32(cloud.centroids + cloud.group_centroids)
    assert int(fields["sector_side"]) == cloud.sector_side
    starts = cloud.runs[::cloud.sector_side ** 2]
    assert list(map(int, fields["cell_begins"].split())) == list(starts[:-1])
    assert list(map(int, fields["group_begins"].split())) == list(cloud.groups[:-1])
    for ours, theirs in zip(cloud.directions, directions):
        assert math.dist(ours, theirs) < 1e-6, (ours, theirs)
        assert abs(math.hypot(*theirs) - 1) < 1e-6
    return True


def main():
    path = os.path.join(FOLDER, "agree.sphc")
    for count, seed in ((16, 1), (17, 2), (500, 3)):
        subprocess.run([MAKE, path, str(count), str(seed)], check=True)
        with open(path, "rb") as stream:
            assert agree(path, stream.read())
    subprocess.run([MAKE, path, "16", "4"], check=True)
    with open(path, "rb") as stream:
        good = stream.read()
    for band, is_known in ((1, True), (2, False), (0x8000, False)):
        other = bytearray(good)
        other[10:12] = band.to_bytes(2, "little")
        table = other[64:64 + 6 * 32]
        other[60:64] = zlib.crc32(other[:60] + b"\0\0\0\0" + table).to_bytes(4, "little")
        with open(path, "wb") as stream:
            stream.write(other)
        assert agree(path, bytes(other)) == is_known
    draw = random.Random(5)
    accepted = 0
    for _ in range(150):  # both must refuse the same damage for the same reason
        bad = bytearray(good)
        for _ in range(draw.randint(1, 3)):
            bad[draw.randrange(len(bad))] ^= 1 << draw.randrange(8)
        if draw.random() < 0.2:
            bad = bad[:draw.randrange(len(bad))]
        with open(path, "wb") as stream:
            stream.write(bad)
        accepted += agree(path, bytes(bad))
    assert accepted == 0, f"{accepted} damaged maps were accepted"
    print("the two readers agree")


if __name__ == "__main__":
    main()
