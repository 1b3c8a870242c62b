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
HEADER = struct.Struct("<8sIIQII16s12sI")
SECTION = struct.Struct("<IIQQII")
VERSION = 1
DIRECTIONS, DESCRIPTORS = 1, 2
ELEMENT_BYTES = {DIRECTIONS: 4, DESCRIPTORS: 128}


class MapError(Exception):
    def __init__(self, status, why):
        super().__init__(f"{status}: {why}")
        self.status = status


class Map:
    """extractor, map_id, directions: list of (x, y, z), descriptors: bytes, 128 a point."""


def _refuse(status, why):
    raise MapError("SPHC_E_MAP_" + status, why)


def _header(file):
    if len(file) < HEADER.size:
        _refuse("FORMAT", "shorter than the header")
    magic, version, extractor, size, points, sections, map_id, reserved, crc = HEADER.unpack_from(file)
    if magic != MAGIC:
        _refuse("FORMAT", "signature")
    if version != VERSION:
        _refuse("VERSION", f"version {version}")
    if size != len(file):
        _refuse("FORMAT", "file size")
    if not 2 <= sections <= 16 or HEADER.size + sections * SECTION.size > len(file):
        _refuse("FORMAT", "section count")
    table = file[HEADER.size:HEADER.size + sections * SECTION.size]
    if zlib.crc32(file[:60] + b"\0\0\0\0" + table) != crc:
        _refuse("CHECKSUM", "header")
    if any(reserved):
        _refuse("FORMAT", "reserved bytes")
    if not 16 <= points <= 1 << 24:
        _refuse("FORMAT", "point count")
    return extractor, points, sections, map_id


def _section(file, index, points, end):
    kind, element, offset, size, crc, reserved = SECTION.unpack_from(file, HEADER.size + index * SECTION.size)
    start = (end + 63) // 64 * 64
    if index > 1 or kind != index + 1:
        _refuse("FORMAT", f"section {index} is of the unknown type {kind}")
    if element != ELEMENT_BYTES[kind] or size != element * points or offset != start or reserved:
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


def read(file, extractor=None):
    """Reads a map; `extractor`: refuse those made by another."""
    result = Map()
    result.extractor, points, sections, result.map_id = _header(file)
    if extractor is not None and result.extractor != extractor:
        _refuse("EXTRACTOR", f"extractor {result.extractor}")
    end = HEADER.size + sections * SECTION.size
    parts = []
    for index in range(sections):
        data, end = _section(file, index, points, end)
        parts.append(data)
    if end != len(file):
        _refuse("FORMAT", "bytes behind the last section")
    packed = list(struct.iter_unpack("<HH", parts[0]))
    if any(u == 0 or v == 0 for u, v in packed):
        _refuse("FORMAT", "a direction is none")
    result.directions = [unpack_direction(u, v) for u, v in packed]
    result.descriptors = parts[1]
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
    print(f"points {len(cloud.directions)}\nextractor {cloud.extractor}\nmap_id {cloud.map_id.hex()}")
    print(f"descriptor_crc {zlib.crc32(cloud.descriptors):08x}")


if __name__ == "__main__":
    main()
