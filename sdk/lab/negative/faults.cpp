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
