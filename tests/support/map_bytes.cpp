#include "tests/support/map_bytes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "runtime/stages/features/extractor.h"
#include "tests/support/random_numbers.h"

namespace sphc::test {
namespace {

constexpr size_t kHeader = 64, kEntry = 32;

uint16_t octahedral(double x) { return static_cast<uint16_t>(32768 + std::lround(x * 32767)); }

void append16(std::vector<uint8_t> *out, uint16_t value) {
  out->push_back(static_cast<uint8_t>(value));
  out->push_back(static_cast<uint8_t>(value >> 8));
}

void appendDirection(std::vector<uint8_t> *out, const Vector3 &d) {
  const double sum = std::abs(d.x()) + std::abs(d.y()) + std::abs(d.z());
  double u = d.x() / sum, v = d.y() / sum;
  if (d.z() < 0) {
    const double folded = (1 - std::abs(v)) * (u < 0 ? -1 : 1);
    v = (1 - std::abs(u)) * (v < 0 ? -1 : 1);
    u = folded;
  }
  append16(out, octahedral(u));
  append16(out, octahedral(v));
}

void padTo64(std::vector<uint8_t> *out) { out->resize((out->size() + 63) / 64 * 64); }

void append32(std::vector<uint8_t> *out, uint32_t value) {
  append16(out, static_cast<uint16_t>(value));
  append16(out, static_cast<uint16_t>(value >> 16));
}

void append(std::vector<uint8_t> *out, const Descriptor &descriptor) {
  out->insert(out->end(), descriptor.bytes, descriptor.bytes + kDescriptorBytes);
}

// A section of what `write` appends, and its entry in the table.
template <typename Write>
void addSection(std::vector<uint8_t> *file, uint32_t index, uint32_t element_bytes, const Write &write) {
  padTo64(file);
  const size_t offset = file->size();
  write();
  const size_t at = kHeader + kEntry * index;
  put32(file, at, index + 1);
  put32(file, at + 4, element_bytes);
  put64(file, at + 8, offset);
  put64(file, at + 16, file->size() - offset);
}

uint64_t squaredDistance(const Descriptor &a, const Descriptor &b) {
  uint64_t sum = 0;
  for (size_t i = 0; i < kDescriptorBytes; ++i) {
    const int difference = a.bytes[i] - b.bytes[i];
    sum += static_cast<uint64_t>(difference * difference);
  }
  return sum;
}

uint32_t nearestOf(const std::vector<Descriptor> &centroids, const Descriptor &descriptor) {
  uint32_t best = 0;
  for (uint32_t c = 1; c < centroids.size(); ++c)
    if (squaredDistance(centroids[c], descriptor) < squaredDistance(centroids[best], descriptor)) best = c;
  return best;
}

uint32_t sectorOf(const Vector3 &direction, uint32_t side) {
  std::vector<uint8_t> packed;
  appendDirection(&packed, direction);
  const uint32_t u = packed[0] + 256u * packed[1], v = packed[2] + 256u * packed[3];
  return (v - 1) * side / 65536 * side + (u - 1) * side / 65536;
}

}  // namespace

void put32(std::vector<uint8_t> *file, size_t at, uint32_t value) {
  for (size_t i = 0; i < 4; ++i) (*file)[at + i] = static_cast<uint8_t>(value >> (8 * i));
}
void put64(std::vector<uint8_t> *file, size_t at, uint64_t value) {
  for (size_t i = 0; i < 8; ++i) (*file)[at + i] = static_cast<uint8_t>(value >> (8 * i));
}
uint32_t get32(const std::vector<uint8_t> &file, size_t at) {
  uint32_t value = 0;
  for (size_t i = 0; i < 4; ++i) value |= uint32_t{file[at + i]} << (8 * i);
  return value;
}
uint64_t get64(const std::vector<uint8_t> &file, size_t at) {
  return get32(file, at) | (uint64_t{get32(file, at + 4)} << 32);
}

uint32_t slowCrc32(const uint8_t *data, size_t bytes) {
  uint32_t crc = UINT32_MAX;
  for (size_t i = 0; i < bytes; ++i) {
    crc ^= data[i];
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (0xEDB88320u & (0 - (crc & 1)));
  }
  return ~crc;
}

void setBand(std::vector<uint8_t> *file, uint32_t band) {
  put32(file, 8, 2 | (band << 16));
  signHeader(file);
}

void signHeader(std::vector<uint8_t> *file) {
  put32(file, 60, 0);
  const size_t covered = kHeader + kEntry * get32(*file, 28);
  put32(file, 60, slowCrc32(file->data(), covered < file->size() ? covered : file->size()));
}

void signSection(std::vector<uint8_t> *file, uint32_t section) {
  const size_t at = kHeader + kEntry * section;
  const auto bytes = static_cast<size_t>(get64(*file, at + 16));
  put32(file, at + 24, slowCrc32(file->data() + get64(*file, at + 8), bytes));
  signHeader(file);
}

std::vector<uint8_t> encodeMap(const std::vector<MapPoint> &points, const MapIndex &index, uint32_t extractor) {
  constexpr uint32_t kSections = 6;
  std::vector<uint8_t> file(kHeader + kSections * kEntry);
  addSection(&file, 0, 4, [&] {
    for (const MapPoint &point : points) appendDirection(&file, point.direction);
  });
  addSection(&file, 1, 128, [&] {
    for (const MapPoint &point : points) append(&file, point.descriptor);
  });
  addSection(&file, 2, 4, [&] {
    for (uint32_t run : index.runs) append32(&file, run);
  });
  addSection(&file, 3, 128, [&] {
    for (const Descriptor &centroid : index.centroids) append(&file, centroid);
  });
  addSection(&file, 4, 4, [&] {
    for (uint32_t group : index.groups) append32(&file, group);
  });
  addSection(&file, 5, 128, [&] {
    for (const Descriptor &centroid : index.group_centroids) append(&file, centroid);
  });

  const uint8_t magic[8] = {0x89, 'S', 'P', 'H', 'C', '\r', '\n', 0x1A};
  for (size_t i = 0; i < 8; ++i) file[i] = magic[i];
  put32(&file, 8, 2);
  put32(&file, 12, extractor);
  put64(&file, 16, file.size());
  put32(&file, 24, static_cast<uint32_t>(points.size()));
  put32(&file, 28, kSections);
  for (size_t i = 0; i < 16; ++i) file[32 + i] = static_cast<uint8_t>(0xA0 + i);
  put32(&file, 48, static_cast<uint32_t>(index.centroids.size()));
  put32(&file, 52, static_cast<uint32_t>(index.group_centroids.size()));
  put32(&file, 56, index.sector_side);
  for (uint32_t i = 0; i < kSections; ++i) signSection(&file, i);
  return file;
}

std::vector<uint8_t> encodeMap(const std::vector<MapPoint> &points, uint32_t extractor) {
  const Descriptor middle = points[0].descriptor;
  return encodeMap(points, {1, {0, static_cast<uint32_t>(points.size())}, {middle}, {0, 1}, {middle}}, extractor);
}

std::vector<uint8_t> encodeIndexedMap(const std::vector<MapPoint> &points, uint32_t cells, uint32_t extractor) {
  MapIndex index = {4, {0}, {}, {0}, {}};
  for (uint32_t c = 0; c < cells; ++c) index.centroids.push_back(points[c].descriptor);
  for (uint32_t c = 0; c < cells; c += 3) {
    index.groups.push_back(std::min(c + 3, cells));
    index.group_centroids.push_back(index.centroids[c]);
  }
  std::vector<std::vector<MapPoint>> lists(16 * cells);
  for (const MapPoint &point : points)
    lists[16 * nearestOf(index.centroids, point.descriptor) + sectorOf(point.direction, 4)].push_back(point);
  std::vector<MapPoint> ordered;
  for (const std::vector<MapPoint> &list : lists) {
    ordered.insert(ordered.end(), list.begin(), list.end());
    index.runs.push_back(static_cast<uint32_t>(ordered.size()));
  }
  return encodeMap(ordered, index, extractor);
}

std::vector<uint8_t> randomMap(uint32_t count, uint64_t seed) {
  Random random(seed);
  std::vector<MapPoint> points;
  for (uint32_t i = 0; i < count; ++i) {
    const Vector3 direction = randomDirection(&random);
    points.push_back({direction, randomDescriptor(&random)});
  }
  return encodeIndexedMap(points, 5, kExtractorId);
}

}  // namespace sphc::test
