#include "lab/worst/cases.h"

#include "lab/deadline/frames.h"
#include "runtime/base/random.h"

namespace sphc::host {
namespace {

constexpr uint32_t kMostKeypoints = 4096;

void noise(uint64_t seed, const Sequence &, Shot *shot) { makeNoise(seed, shot); }

// `value(x, y)` in every channel.
template <typename Value>
void paint(const Sequence &sequence, const Value &value, Shot *shot) {
  const uint32_t channels = sequence.channels(), width = sequence.colorWidth();
  for (size_t i = 0; i < shot->color.size(); ++i) {
    const uint32_t pixel = static_cast<uint32_t>(i / channels);
    shot->color[i] = value(pixel % width, pixel / width);
  }
}

// As many keypoints as there are dots, and every one looks like every other.
void dots(uint64_t, const Sequence &sequence, Shot *shot) {
  constexpr uint32_t kPeriod = 8;
  paint(
      sequence, [](uint32_t x, uint32_t y) -> uint8_t { return x % kPeriod < 3 && y % kPeriod < 3 ? 20 : 220; },
      shot);
}

void checkers(uint64_t, const Sequence &sequence, Shot *shot) {
  constexpr uint32_t kSide = 8;
  paint(
      sequence, [](uint32_t x, uint32_t y) -> uint8_t { return (x / kSide + y / kSide) % 2 ? 30 : 200; }, shot);
}

// Every second pixel is twice as far.
void depthEdges(uint64_t, const Sequence &sequence, Shot *shot) {
  const uint32_t width = sequence.depthWidth();
  for (size_t i = 0; i < shot->depth.size(); ++i)
    if ((i % width + i / width) % 2) shot->depth[i] = static_cast<uint16_t>(2 * shot->depth[i]);
}

void depthNoise(uint64_t seed, const Sequence &, Shot *shot) {
  Random random(seed);
  for (uint16_t &value : shot->depth) value = static_cast<uint16_t>(random.below(8000));
}

// Everything matches, and no two matches agree: every search goes on to its end.
MapFile shuffledDirections(const MapFile &map) {
  SphereCloud cloud = cloudOf(map);
  Random random(1);
  for (size_t i = cloud.points.size(); i > 1; --i)
    std::swap(cloud.points[i - 1].direction, cloud.points[random.below(static_cast<uint32_t>(i))].direction);
  return openMapBytes(encodeMap(cloud, {}));
}

// All points are in one sector, and all matches agree on nothing but a direction.
MapFile oneDirection(const MapFile &map) {
  SphereCloud cloud = cloudOf(map);
  for (SpherePoint &point : cloud.points) point.direction = cloud.points[0].direction;
  return openMapBytes(encodeMap(cloud, {}));
}

MapFile oneDescriptor(const MapFile &map) {
  SphereCloud cloud = cloudOf(map);
  for (SpherePoint &point : cloud.points) point.descriptor = cloud.points[0].descriptor;
  return openMapBytes(encodeMap(cloud, {}));
}

Parameters exact() {
  Parameters parameters;
  parameters.probes = 0;
  return parameters;
}

}  // namespace

std::vector<WorstCase> worstCases() {
  return {{"normal", nullptr, nullptr},
          {"white noise", noise, nullptr},
          {"dots", dots, nullptr},
          {"checkers", checkers, nullptr},
          {"depth full of edges", depthEdges, nullptr},
          {"depth of noise", depthNoise, nullptr},
          {"all matches wrong", nullptr, shuffledDirections},
          {"one direction", nullptr, oneDirection},
          {"one descriptor", nullptr, oneDescriptor},
          {"one descriptor, dots", dots, oneDescriptor},
          {"one cell", nullptr, inOneCell},
          {"one cell, white noise", noise, inOneCell},
          {"4096 keypoints", nullptr, nullptr, kMostKeypoints},
          {"4096 keypoints, white noise", noise, nullptr, kMostKeypoints},
          {"4096 keypoints, all matches wrong", nullptr, shuffledDirections, kMostKeypoints},
          {"4096 keypoints, exact, white noise", noise, nullptr, kMostKeypoints, exact()}};
}

}  // namespace sphc::host
