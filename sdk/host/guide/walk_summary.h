// What a walk came to, for somebody who may walk again before leaving.
#pragma once
#include "host/guide/advice.h"
#include "host/guide/places.h"

namespace sphc::host {

// A frame that the guide saw.
struct Look {
  int64_t time_ns = 0;
  GuideAdvice advice = 0;       // but for kGoBack and kLookAgain, which only the whole walk decides
  uint32_t place = UINT32_MAX;  // that it follows; UINT32_MAX: none
};

// Will be hard to map.
struct HardStretch {
  double from_s = 0, to_s = 0;  // since the first frame
  GuideAdvice advice = 0;       // that at least half of its frames have
};

struct WalkSummary {
  uint32_t frames = 0, followed = 0;  // looked at; of these, with a place in the largest part
  double seconds = 0, path_m = 0;
  uint32_t places = 0, parts = 0, loops = 0;
  uint32_t seen_again = 0;        // places
  bool begin_seen_again = false;  // by a loop to one of the first places
  std::vector<HardStretch> hard;
};

WalkSummary summaryOf(const std::vector<Look> &looks, const std::vector<GuidePlace> &places, uint32_t largest_part,
                      uint32_t loops);

// Fewer inliers hold a place to the rest weakly.
constexpr uint32_t kThinInliers = 30;
// A loop to a place so soon after the first frame goes back to the begin.
constexpr int64_t kBeginNs = 3000000000;

}  // namespace sphc::host
