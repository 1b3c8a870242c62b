#include "runtime/localizer/ranking.h"

#include <algorithm>
#include <utility>

#include "runtime/localizer/tuning.h"

namespace sphc {

RankedPose *Ranking::find(const Rigid &camera_from_map, uint32_t map_id) {
  return std::find_if(poses_, poses_ + count_, [&](const RankedPose &known) {
    return known.map_id == map_id && areNear(known.camera_from_map, camera_from_map, tuning::kSamePose);
  });
}

void Ranking::add(const Hypothesis &tried, uint32_t map_id) {
  if (!tried.hasPose()) return;
  const Estimate &estimate = tried.estimate;
  RankedPose *place = find(estimate.camera_from_map, map_id);
  if (place == poses_ + kMost) --place;  // the last one gives way, if it gains less
  const bool is_new = place == poses_ + count_;
  if (!is_new && place->gain >= estimate.gain) return;
  count_ += is_new;
  *place = {map_id,        estimate.camera_from_map,  tried.outcome, false, estimate.inliers,
            estimate.gain, tried.evidence.logChance()};
  for (; place > poses_ && place->gain > place[-1].gain; --place) std::swap(place[0], place[-1]);
}

void Ranking::markAnswer(const Rigid &camera_from_map, uint32_t map_id) {
  RankedPose *answer = find(camera_from_map, map_id);
  if (answer != poses_ + count_) answer->is_answer = true;
}

}  // namespace sphc
