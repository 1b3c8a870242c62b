// Extractors side by side on the frames of a recording: how long, how many, and how many matches the recorded poses
// confirm.
#pragma once
#include <array>
#include <functional>

#include "lab/features/frames.h"
#include "lab/features/variant.h"

namespace sphc::host {

constexpr std::array<uint32_t, 2> kFeatureGaps = {8, 20};  // frames from one image of a pair to the other

struct FeaturesOptions {
  uint32_t repeats = 3;  // of every extraction below 50 ms; the time is their median
  uint32_t every = 4;    // frames from one pair to the next
};

struct PairQuality {
  size_t pairs = 0;
  double matches = 0, verified = 0;  // a pair, mean
  double sampson_px = 0;             // median of the verified
};

struct FeaturesSummary {
  std::string name;
  double keypoints = 0;  // mean
  double median_ms = 0, p99_ms = 0;
  double times_faster_than_opencv = 0;  // ratio of the medians; NaN without it
  std::array<PairQuality, kFeatureGaps.size()> gaps;
};

using FramesDone = std::function<void(uint32_t done, uint32_t total)>;

// Every frame of a pair through every variant in turn; then the pairs.  Absent variants are left out.
std::vector<FeaturesSummary> runFeaturesBench(const GrayRecording &recording,
                                              const std::vector<FeaturesVariant> &variants,
                                              const FeaturesOptions &options, const FramesDone &frame_done);

}  // namespace sphc::host
