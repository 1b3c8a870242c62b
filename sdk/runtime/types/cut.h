// What was left out of a frame for its deadline.
#pragma once
#include <cstdint>

namespace sphc {

using Cuts = uint32_t;  // bits

constexpr Cuts kCutFeatures = 1;      // fine scales of the image, or the weakest keypoints
constexpr Cuts kCutMatches = 2;       // keypoints, of which some were not compared with the map
constexpr Cuts kCutSearch = 4;        // samples, or searches that might have followed
constexpr Cuts kCutVerification = 8;  // steps that refine, challenge or confirm a pose

}  // namespace sphc
