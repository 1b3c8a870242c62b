#include "lab/match/case.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "lab/common/normal.h"

namespace sphc::host {
namespace {

constexpr double kByteNoise = 12, kScatter = 0.31622776601683794;
constexpr int kSide = 4, kBins = 8;  // of a descriptor: kSide x kSide cells of kBins orientations

size_t placeOf(int row, int column, int bin) { return static_cast<size_t>((row * kSide + column) * kBins + bin); }

// A column to the other side; an orientation to its mirror image.
Descriptor mirrored(const Descriptor &from) {
  Descriptor to;
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column)
      for (int bin = 0; bin < kBins; ++bin)
        to.bytes[placeOf(row, kSide - 1 - column, (kBins + kBins / 2 - bin) % kBins)] =
            from.bytes[placeOf(row, column, bin)];
  return to;
}

Descriptor turned(const Descriptor &from) {
  Descriptor to;
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column)
      for (int bin = 0; bin < kBins; ++bin)
        to.bytes[placeOf(column, kSide - 1 - row, (bin + kBins / 4) % kBins)] =
            from.bytes[placeOf(row, column, bin)];
  return to;
}

Vector3 scattered(const Vector3 &direction, Random *random) {
  return (direction + kScatter * normalVector(random)).normalized();
}

MatchPoint madePoint(const std::vector<MatchPoint> &points, Random *random) {
  const MatchPoint &looks = points[random->below(static_cast<uint32_t>(points.size()))];
  const MatchPoint &place = points[random->below(static_cast<uint32_t>(points.size()))];
  MatchPoint made = {scattered(place.direction, random), transformed(looks.descriptor, 1 + random->below(7))};
  for (uint8_t &byte : made.descriptor.bytes)
    byte = static_cast<uint8_t>(std::clamp(std::lround(byte + kByteNoise * normalOf(random)), 0l, 255l));
  return made;
}

}  // namespace

Descriptor transformed(const Descriptor &descriptor, uint32_t transform) {
  Descriptor result = transform & 1 ? mirrored(descriptor) : descriptor;
  for (uint32_t quarter = 0; quarter < transform >> 1; ++quarter) result = turned(result);
  return result;
}

std::vector<MatchPoint> grownPoints(const std::vector<MatchPoint> &points, size_t count, uint64_t seed) {
  std::vector<MatchPoint> grown(points.begin(),
                                points.begin() + static_cast<ptrdiff_t>(std::min(count, points.size())));
  Random random(seed);
  while (grown.size() < count) grown.push_back(madePoint(points, &random));
  for (size_t i = grown.size(); i > 1; --i)  // Fisher and Yates
    std::swap(grown[i - 1], grown[random.below(static_cast<uint32_t>(i))]);
  return grown;
}

MatchCase makeMatchCase(const std::vector<uint8_t> &map_file, uint32_t extractor, double build_seconds,
                        const std::vector<MatchPoint> &queries) {
  constexpr size_t kPage = 4096;
  MatchCase c;
  c.file.reset(std::aligned_alloc(kPage, (map_file.size() + kPage - 1) / kPage * kPage), std::free);
  if (!c.file) throw std::runtime_error("not enough memory for a map; choose smaller --sizes");
  std::memcpy(c.file.get(), map_file.data(), map_file.size());
  sphc_message message = {};
  if (MapView::open(c.file.get(), map_file.size(), extractor, &c.map, &message) != SPHC_OK)
    throw std::runtime_error(message.text);
  c.map_bytes = static_cast<double>(map_file.size());
  c.build_seconds = build_seconds;
  for (const MatchPoint &query : queries) {
    c.queries.push_back(query.descriptor);
    const auto f = query.direction.cast<float>();
    c.expected.push_back({f.x(), f.y(), f.z()});
  }
  return c;
}

}  // namespace sphc::host
