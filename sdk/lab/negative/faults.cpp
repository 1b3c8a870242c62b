#include <algorithm>

#include "lab/common/normal.h"
#include "lab/negative/fault.h"

namespace sphc::host {
namespace {

// Of each measurement by itself.
void addNoiseOfDepth(Sequence *sequence) {
  constexpr double kShare = 0.025;
  Random random(1);
  for (Shot &shot : sequence->shots)
    for (uint16_t &value : shot.depth)
      if (value) value = static_cast<uint16_t>(std::clamp(value * (1 + kShare * normalOf(&random)), 1.0, 65535.0));
}

// Sum and number of measurements.
struct Measured {
  uint32_t sum = 0, count = 0;
};

// Of those up to `reach` away along a line of `count`, which lie `stride` apart.
void addNeighbours(const Measured *line, size_t count, size_t stride, size_t reach, Measured *out) {
  for (size_t i = 0; i < count; ++i)
    for (size_t j = i - std::min(i, reach); j <= std::min(count - 1, i + reach); ++j) {
      out[i * stride].sum += line[j * stride].sum;
      out[i * stride].count += line[j * stride].count;
    }
}

// As a filter does: the mean of what is measured around.
void smooth(bool fills_holes, Sequence *sequence) {
  const size_t width = sequence->depthWidth(), height = sequence->depthHeight();
  const size_t reach = std::max<size_t>(1, (width + 50) / 100);
  for (Shot &shot : sequence->shots) {
    std::vector<Measured> own, across(width * height), around(width * height);
    for (const uint16_t value : shot.depth) own.push_back({value, value ? 1u : 0u});
    for (size_t y = 0; y < height; ++y) addNeighbours(&own[y * width], width, 1, reach, &across[y * width]);
    for (size_t x = 0; x < width; ++x) addNeighbours(&across[x], height, width, reach, &around[x]);
    for (size_t i = 0; i < around.size(); ++i)
      if (own[i].count || fills_holes)
        shot.depth[i] = static_cast<uint16_t>(around[i].sum / std::max(1u, around[i].count));
  }
}

void smoothDepth(Sequence *sequence) { smooth(false, sequence); }
void smoothAndFillDepth(Sequence *sequence) { smooth(true, sequence); }

// In the values of the image: what was bright is white.
void doubleTheLight(Sequence *sequence) {
  for (Shot &shot : sequence->shots)
    for (uint8_t &value : shot.color) value = static_cast<uint8_t>(std::min(22 * value / 10 + 20, 255));
}

// Poses may be lost in these, but no fault is to be named.
std::vector<SensorFault> soundFrames() {
  return {{"healthy", [](Sequence *) {}, 0, false, false},
          {"healthy, odometry", [](Sequence *) {}, 0, true, false},
          {"healthy, depth noise 2.5 %", addNoiseOfDepth, 0, false, false},
          {"healthy, depth smoothed", smoothDepth, 0, false, false},
          {"healthy, depth smoothed, holes filled", smoothAndFillDepth, 0, false, false},
          {"healthy, twice the light", doubleTheLight, 0, false, false}};
}

}  // namespace

std::vector<SensorFault> allFaults() {
  std::vector<SensorFault> all = soundFrames();
  for (const auto &kind : {depthFaults(), colorFaults(), calibrationFaults(), odometryFaults(), priorFaults()})
    all.insert(all.end(), kind.begin(), kind.end());
  return all;
}

}  // namespace sphc::host
