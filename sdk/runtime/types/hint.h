// Why a frame has no pose, for the person who wears the cameras.
#pragma once
#include <cstdint>

namespace sphc {

using Hints = uint32_t;  // bits

constexpr Hints kTooDark = 1;         // noise is not far below the light
constexpr Hints kTooFast = 2;         // blurred along a line
constexpr Hints kTooPlain = 4;        // little stands out, though bright and sharp
constexpr Hints kNoDepthInRange = 8;  // few keypoints have depth
constexpr Hints kNotInMap = 16;       // the image shows enough, but not what the maps show
constexpr Hints kAmbiguous = 32;      // a rival is nearly as good, or odometry contradicts the pose

}  // namespace sphc
