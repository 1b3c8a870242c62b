// The poses that a frame may have, as far as they were looked at, each once: what gains most comes first.
#pragma once
#include "runtime/localizer/hypothesis.h"

namespace sphc {

struct RankedPose {
  uint32_t map_id = 0;
  Rigid camera_from_map;
  Outcome outcome = Outcome::kUncertain;  // what the pose would be without rivals: localized or uncertain
  bool is_answer = false;
  uint32_t inliers = 0;
  double gain = 0;
  double log_chance = 0;  // judgement.h
};

class Ranking {
 public:
  static constexpr uint32_t kMost = 8;

  void clear() { count_ = 0; }
  // After guided re-matching.  A pose that chance explains is left out.
  void add(const Hypothesis &tried, uint32_t map_id);
  // This one is what the frame is answered with.
  void markAnswer(const Rigid &camera_from_map, uint32_t map_id);
  Span<const RankedPose> poses() const { return {poses_, count_}; }

 private:
  RankedPose *find(const Rigid &camera_from_map, uint32_t map_id);

  RankedPose poses_[kMost];
  uint32_t count_ = 0;
};

}  // namespace sphc
