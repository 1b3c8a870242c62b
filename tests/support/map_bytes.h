// Sphere-cloud files for tests, written byte by byte from docs/map_format.md and not by the builder's code: what
// both the reader and this writer agree on is the format.
#pragma once
#include <cstdint>
#include <vector>

#include "runtime/geometry/rotation.h"
#include "runtime/types/keypoint.h"

namespace sphc::test {

struct MapPoint {
  Vector3 direction;
  Descriptor descriptor;
};

std::vector<uint8_t> encodeMap(const std::vector<MapPoint> &points, uint32_t extractor);
// `count` points of random direction and descriptor.
std::vector<uint8_t> randomMap(uint32_t count, uint64_t seed);

// Make the checksums right again after a change, so that the check behind them is reached.
void signHeader(std::vector<uint8_t> *file);
void signSection(std::vector<uint8_t> *file, uint32_t section);  // and the header

// Little-endian fields at a byte offset.
void put32(std::vector<uint8_t> *file, size_t at, uint32_t value);
void put64(std::vector<uint8_t> *file, size_t at, uint64_t value);
uint32_t get32(const std::vector<uint8_t> &file, size_t at);
uint64_t get64(const std::vector<uint8_t> &file, size_t at);

// A plain bit-by-bit CRC-32.
uint32_t slowCrc32(const uint8_t *data, size_t bytes, uint32_t crc = 0);

}  // namespace sphc::test
