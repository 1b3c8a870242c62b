#!/usr/bin/env python3
"""A second reader of the sphere-cloud map format, written from docs/map_format.md alone.

    read_map.py FILE     prints what is in it; exit code 0, or 1 with the reason when the file is refused

Standard library only.  read(bytes) -> Map, or raises MapError with .status, the name the C library would return.
"""
import math
import struct
import sys
import zlib

MAGIC = b"\x89SPHC\r\n\x1a"
HEADER = struct.Struct("<8sHHIQII16sIIII")
SECTION = struct.Struct("<IIQQII")
VERSION = 2
BANDS = ("visible", "infrared")
SECTIONS = 6
DIRECTIONS, DESCRIPTORS, RUNS, CENTROIDS, GROUPS, GROUP_CENTROIDS = range(1, 7)


class MapError(Exception):
    def __init__(self, status, why):
        super().__init__(f"{status}: {why}")
        self.status = status


class Map:
    """extractor, band: of BANDS, map_id, directions: list of (x, y, z), descriptors: bytes, 128 a point.

    The index: cells, sector_side, runs: where each sector of each cell begins, centroids: bytes, 128 a cell,
    groups: where each group of cells begins, group_centroids: bytes, 128 a group.
    """


def _refuse(status, why):
    raise MapError("SPHC_E_MAP_" + status, why)


def _header(file):
    if len(file) < HEADER.size:
        _refuse("FORMAT", "shorter than the header")
    (magic, version, band, extractor, size, points, sections, map_id, cells, groups, side,
     crc) = HEADER.unpack_from(file)
    if magic != MAGIC:
        _refuse("FORMAT", "signature")
    if version != VERSION:
        _refuse("VERSION", f"version {version}")
    if size != len(file):
        _refuse("FORMAT", "file size")
    if sections != SECTIONS or HEADER.size + sections * SECTION.size > len(file):
        _refuse("FORMAT", "section count")
    table = file[HEADER.size:HEADER.size + sections * SECTION.size]
    if zlib.crc32(file[:60] + b"\0\0\0\0" + table) != crc:
        _refuse("CHECKSUM", "header")
    if not 16 <= points <= 1 << 24:
        _refuse("FORMAT", "point count")
    if not 1 <= cells <= 4096 or not 1 <= groups <= min(256, cells):
        _refuse("FORMAT", "cells and groups")
    if side not in (1, 2, 4, 8, 16, 32):
        _refuse("FORMAT", "sector side")
    if band >= len(BANDS):
        _refuse("VERSION", f"band {band}")
    return extractor, BANDS[band], map_id, points, cells, groups, side


def _section(file, index, shape, end):
    kind, element, offset, size, crc, reserved = SECTION.unpack_from(file, HEADER.size + index * SECTION.size)
    start = (end + 63) // 64 * 64
    if kind != index + 1:
        _refuse("FORMAT", f"section {index} is of the unexpected type {kind}")
    element_bytes, count = shape
    if element != element_bytes or size != element * count or offset != start or reserved:
        _refuse("FORMAT", f"section {index} does not fit")
    if offset + size > len(file):
        _refuse("FORMAT", f"section {index} reaches beyond the end")
    if any(file[end:start]):
        _refuse("FORMAT", "padding")
    data = file[offset:offset + size]
    if zlib.crc32(data) != crc:
        _refuse("CHECKSUM", f"section {index}")
    return data, offset + size


def unpack_direction(u16, v16):
    u, v = (u16 - 32768) / 32767, (v16 - 32768) / 32767
    x, y, z = u, v, 1 - abs(u) - abs(v)
    if z < 0:
        x, y = math.copysign(1 - abs(v), u), math.copysign(1 - abs(u), v)
    length = math.sqrt(x * x + y * y + z * z)
    return x / length, y / length, z / length


def _offsets(data, total):
    offsets = struct.unpack(f"<{len(data) // 4}I", data)
    if offsets[0] != 0 or offsets[-1] != total or any(a > b for a, b in zip(offsets, offsets[1:])):
        _refuse("FORMAT", "offsets of the index")
    return offsets


def _check_sectors(packed, runs, side):
    for run in range(len(runs) - 1):
        row, column = divmod(run % (side * side), side)
        for u, v in packed[runs[run]:runs[run + 1]]:
            if (v - 1) * side // 65536 != row or (u - 1) * side // 65536 != column:
                _refuse("FORMAT", "a point in another sector than the index says")


def read(file, extractor=None):
    """Reads a map; `extractor`: refuse those made by another."""
    result = Map()
    result.extractor, result.band, result.map_id, points, result.cells, groups, side = _header(file)
    if extractor is not None and result.extractor != extractor:
        _refuse("EXTRACTOR", f"extractor {result.extractor}")
    shapes = {DIRECTIONS: (4, points), DESCRIPTORS: (128, points), RUNS: (4, result.cells * side * side + 1),
              CENTROIDS: (128, result.cells), GROUPS: (4, groups + 1), GROUP_CENTROIDS: (128, groups)}
    end = HEADER.size + SECTIONS * SECTION.size
    parts = {}
    for index in range(SECTIONS):
        parts[index + 1], end = _section(file, index, shapes[index + 1], end)
    if end != len(file):
        _refuse("FORMAT", "bytes behind the last section")
    packed = list(struct.iter_unpack("<HH", parts[DIRECTIONS]))
    if any(u == 0 or v == 0 for u, v in packed):
        _refuse("FORMAT", "a direction is none")
    result.groups = _offsets(parts[GROUPS], result.cells)
    result.runs = _offsets(parts[RUNS], points)
    _check_sectors(packed, result.runs, side)
    result.sector_side = side
    result.directions = [unpack_direction(u, v) for u, v in packed]
    result.descriptors = parts[DESCRIPTORS]
    result.centroids, result.group_centroids = parts[CENTROIDS], parts[GROUP_CENTROIDS]
    return result


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    try:
        with open(sys.argv[1], "rb") as stream:
            cloud = read(stream.read())
    except MapError as error:
        print(error)
        sys.exit(1)
    print(f"points {len(cloud.directions)}\nextractor {cloud.extractor}\nband {cloud.band}\nmap_id {cloud.map_id.hex()}")
    print(f"cells {cloud.cells}\ngroups {len(cloud.groups) - 1}\nsector_side {cloud.sector_side}")
    print(f"descriptor_crc {zlib.crc32(cloud.descriptors):08x}")


if __name__ == "__main__":
    main()
