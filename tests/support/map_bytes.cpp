#include "tests/support/map_bytes.h"

#include <cmath>

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

void putEntry(std::vector<uint8_t> *file, uint32_t index, uint32_t element_bytes, size_t offset, size_t bytes) {
  const size_t at = kHeader + kEntry * index;
  put32(file, at, index + 1);
  put32(file, at + 4, element_bytes);
  put64(file, at + 8, offset);
  put64(file, at + 16, bytes);
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

uint32_t slowCrc32(const uint8_t *data, size_t bytes, uint32_t crc) {
  crc = ~crc;
  for (size_t i = 0; i < bytes; ++i) {
    crc ^= data[i];
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) ? (crc >> 1) ^ 0xEDB88320u : crc >> 1;
  }
  return ~crc;
}

void signHeader(std::vector<uint8_t> *file) {
  put32(file, 60, 0);
  const size_t covered = kHeader + kEntry * get32(*file, 28);
  put32(file, 60, slowCrc32(file->data(), covered < file->size() ? covered : file->size()));
}

void signSection(std::vector<uint8_t> *file, uint32_t section) {
  const size_t at = kHeader + kEntry * section;
  put32(file, at + 24, slowCrc32(file->data() + get64(*file, at + 8), get64(*file, at + 16)));
  signHeader(file);
}

std::vector<uint8_t> encodeMap(const std::vector<MapPoint> &points, uint32_t extractor) {
  std::vector<uint8_t> file(kHeader + 2 * kEntry);
  padTo64(&file);
  const size_t directions = file.size();
  for (const MapPoint &point : points) appendDirection(&file, point.direction);
  padTo64(&file);
  const size_t descriptors = file.size();
  for (const MapPoint &point : points)
    file.insert(file.end(), point.descriptor.bytes, point.descriptor.bytes + kDescriptorBytes);

  const uint8_t magic[8] = {0x89, 'S', 'P', 'H', 'C', '\r', '\n', 0x1A};
  for (size_t i = 0; i < 8; ++i) file[i] = magic[i];
  put32(&file, 8, 1);
  put32(&file, 12, extractor);
  put64(&file, 16, file.size());
  put32(&file, 24, static_cast<uint32_t>(points.size()));
  put32(&file, 28, 2);
  for (size_t i = 0; i < 16; ++i) file[32 + i] = static_cast<uint8_t>(0xA0 + i);
  putEntry(&file, 0, 4, directions, 4 * points.size());
  putEntry(&file, 1, 128, descriptors, 128 * points.size());
  signSection(&file, 0);
  signSection(&file, 1);
  return file;
}

std::vector<uint8_t> randomMap(uint32_t count, uint64_t seed) {
  Random random(seed);
  std::vector<MapPoint> points;
  for (uint32_t i = 0; i < count; ++i) {
    const Vector3 direction = randomDirection(&random);
    points.push_back({direction, randomDescriptor(&random)});
  }
  return encodeMap(points, kExtractorId);
}

}  // namespace sphc::test
