// One way to localize a frame among those that are measured.
#pragma once
#include <spherecloud/spherecloud.h>

#include <array>
#include <functional>
#include <string>

#include "host/report/statistics.h"
#include "lab/pose/variant.h"

namespace sphc::host {

struct FrameCase {
  uint32_t index = 0;  // frames come in order of time
  sphc_localizer_frame image = {};
  Rigid truth_camera_from_world;
  const sphc_localizer_prior *odometry = nullptr;  // as a headset's dead reckoning would tell it; null: nothing
};

constexpr Stage kStages[] = {kFeatures, kAlign, kMatch, kPose};  // in a frame's order
using StageSeconds = std::array<double, kStageCount>;            // by Stage; NaN: the variant has no such stage

struct FrameAnswer {
  PoseAnswer pose;  // the recording's world is its map frame; `seconds` is the whole frame
  StageSeconds stages = {};
};

// A frame may be given several times, `repeat` 0 first; what is remembered from frame to frame is remembered for
// each repeat by itself.
using FrameFunction = std::function<FrameAnswer(const FrameCase &, uint32_t repeat)>;

struct FrameMemory {
  size_t state_bytes = 0, scratch_bytes = 0, map_bytes = 0;  // all 0: not told
};

struct FrameVariant {
  std::string name;
  FrameFunction run;   // empty: absent
  std::string absent;  // then: why, and the cure
  FrameMemory memory;
};

}  // namespace sphc::host
