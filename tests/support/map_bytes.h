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

// The index of a map, as docs/map_format.md names its parts.
struct MapIndex {
  uint32_t sector_side;
  std::vector<uint32_t> runs;
  std::vector<Descriptor> centroids;
  std::vector<uint32_t> groups;
  std::vector<Descriptor> group_centroids;
};

// `points` in the order of the index.
std::vector<uint8_t> encodeMap(const std::vector<MapPoint> &points, const MapIndex &index, uint32_t extractor);
// With the least index: one cell, so that points keep any order.
std::vector<uint8_t> encodeMap(const std::vector<MapPoint> &points, uint32_t extractor);
// With an index of `cells` cells around the first descriptors, in groups of three, and 4 x 4 sectors.
std::vector<uint8_t> encodeIndexedMap(const std::vector<MapPoint> &points, uint32_t cells, uint32_t extractor);
// `count` points of random direction and descriptor, in 5 cells.
std::vector<uint8_t> randomMap(uint32_t count, uint64_t seed);

// Of what light the map's images were, by its number; the header is signed anew.
void setBand(std::vector<uint8_t> *file, uint32_t band);

// Make the checksums right again after a change, so that the check behind them is reached.
void signHeader(std::vector<uint8_t> *file);
void signSection(std::vector<uint8_t> *file, uint32_t section);  // and the header

// Little-endian fields at a byte offset.
void put32(std::vector<uint8_t> *file, size_t at, uint32_t value);
void put64(std::vector<uint8_t> *file, size_t at, uint64_t value);
uint32_t get32(const std::vector<uint8_t> &file, size_t at);
uint64_t get64(const std::vector<uint8_t> &file, size_t at);

// A plain bit-by-bit CRC-32.
uint32_t slowCrc32(const uint8_t *data, size_t bytes);

}  // namespace sphc::test
