#include <algorithm>

#include "lab/negative/fault.h"
#include "lab/negative/flip.h"

namespace sphc::host {
namespace {

using Change = std::function<uint16_t(double)>;  // of a measurement, sensor units

void changeValues(Sequence *sequence, const Change &change) {
  for (Shot &shot : sequence->shots)
    for (uint16_t &value : shot.depth)
      if (value) value = change(value);
}

uint16_t saturated(double value) { return static_cast<uint16_t>(std::min(65535.0, std::max(1.0, value))); }

void makeConstant(Sequence *sequence) {
  const double units = 2 / sequence->rig.depth_unit_m;
  for (Shot &shot : sequence->shots) std::fill(shot.depth.begin(), shot.depth.end(), saturated(units));
}

// Far becomes near, and near far, in a range of 0.25 to 6 m.
void invert(Sequence *sequence) {
  const double sum = 6.25 / sequence->rig.depth_unit_m;
  changeValues(sequence, [sum](double value) { return saturated(std::max(sum - value, 0.04 * sum)); });
}

// As much as the sensor's own range: a number of disparity where a depth should be.
void makeDisparity(Sequence *sequence) {
  const double units = 1 / sequence->rig.depth_unit_m;
  changeValues(sequence, [units](double value) { return saturated(2 * units * units / value); });
}

std::function<void(Sequence *)> scale(double factor) {
  return [factor](Sequence *s) { changeValues(s, [factor](double value) { return saturated(factor * value); }); };
}

// The image is `seconds` old, and says that it is new unless its time is told.
std::function<void(Sequence *)> delay(double seconds, bool time_is_told) {
  return [seconds, time_is_told](Sequence *sequence) {
    const std::vector<Shot> before = sequence->shots;
    const auto wanted_ns = static_cast<int64_t>(1e9 * seconds);
    size_t first = before.size();
    for (size_t i = before.size(); i-- > 0;) {
      size_t old = i;
      while (old > 0 && before[i].depth_time_ns - before[old].depth_time_ns < wanted_ns) --old;
      if (before[i].depth_time_ns - before[old].depth_time_ns < wanted_ns) break;
      sequence->shots[i].depth = before[old].depth;
      if (time_is_told) sequence->shots[i].depth_time_ns = before[old].depth_time_ns;
      first = i;
    }
    sequence->shots.erase(sequence->shots.begin(), sequence->shots.begin() + static_cast<std::ptrdiff_t>(first));
  };
}

void freezeDepth(Sequence *sequence) {
  for (size_t i = 1; i < sequence->shots.size(); ++i) sequence->shots[i].depth = sequence->shots[0].depth;
}

void mirrorDepth(Sequence *s) {
  for (Shot &shot : s->shots) mirror(s->depthWidth(), s->depthHeight(), 1, &shot.depth);
}

void turnDepthUpsideDown(Sequence *s) {
  for (Shot &shot : s->shots) turnUpsideDown(s->depthWidth(), s->depthHeight(), 1, &shot.depth);
}

}  // namespace

std::vector<SensorFault> depthFaults() {
  const uint32_t disagree = SPHC_FAULT_DEPTH_COLOR_DISAGREE, scaled = SPHC_FAULT_DEPTH_SCALE;
  const uint32_t frozen = SPHC_FAULT_DEPTH_FROZEN | disagree;
  const uint32_t bent =
      SPHC_FAULT_DEPTH_BENT | disagree | SPHC_FAULT_DISTANCES_DISAGREE | SPHC_FAULT_FOCAL_DISAGREES;
  return {{"depth constant", makeConstant, SPHC_FAULT_DEPTH_CONSTANT, false, false},
          {"depth inverted", invert, bent, false, false},
          {"depth is disparity", makeDisparity, bent, false, false},
          {"depth times 1000", scale(1000), SPHC_FAULT_DEPTH_RANGE, false, false},
          {"depth 0.1 s late", delay(0.09, false), disagree, false, false},
          {"depth 0.3 s late", delay(0.29, false), disagree, false, false},
          {"depth 1 s late", delay(0.99, false), disagree, false, false},
          {"depth 0.1 s late, times told", delay(0.09, true), disagree, false, false},
          {"depth 0.3 s late, times told", delay(0.29, true), disagree, false, false},
          {"healthy, depth 0.1 s late, times told, odometry", delay(0.09, true), 0, true, false},
          {"healthy, depth 0.3 s late, times told, odometry", delay(0.29, true), 0, true, false},
          {"depth frozen", freezeDepth, frozen, false, false},
          {"depth mirrored", mirrorDepth, disagree, false, false},
          {"depth upside down", turnDepthUpsideDown, disagree, false, false},
          {"depth times 0.5, odometry", scale(0.5), scaled | disagree, true, false},
          {"depth times 1.1, odometry", scale(1.1), scaled | disagree, true, false}};
}

}  // namespace sphc::host
