#include "runtime/localizer/history.h"

#include <algorithm>

#include "runtime/localizer/tuning.h"

namespace sphc {

void History::layout(uint32_t capacity, Arena &state, History *history) {
  const Span<OldMatch> matches = state.take<OldMatch>("localizer.history", capacity);
  if (history) history->matches_ = matches;
}

void History::advance(const Rigid &now_from_before, double rotation_sigma_rad, double translation_sigma_m) {
  const double turn_variance = rotation_sigma_rad * rotation_sigma_rad,
               shift_variance = translation_sigma_m * translation_sigma_m;
  for (uint32_t age = tuning::kMostFramesTogether; age > 0; --age)
    since_[age] = {since_[age - 1].turn_variance + turn_variance, since_[age - 1].shift_variance + shift_variance};
  uint32_t kept = 0;
  for (uint32_t i = 0; i < count_; ++i) {
    OldMatch match = matches_[i];
    LiftedPoint &lifted = match.lifted;
    match.depth_ray = now_from_before.rotation * match.depth_ray;
    lifted.point_m = now_from_before * lifted.point_m;
    match.rest_variance += turn_variance * lifted.point_m.squaredNorm() + shift_variance;
    // What of the depth error now lies across the viewing ray adds to the error there.
    const double cosine = match.depth_ray.dot(lifted.point_m.normalized());
    const double cosine2 = std::min(1.0, cosine * cosine);
    lifted.sideways_m = sqrtOf(match.rest_variance + match.depth_variance * (1 - cosine2));
    lifted.along_m = sqrtOf(match.rest_variance + match.depth_variance * cosine2);
    if (++match.age <= tuning::kMostFramesTogether && lifted.sideways_m < tuning::kVagueM) matches_[kept++] = match;
  }
  count_ = kept;
}

void History::add(const LiftedPoint &lifted, uint32_t point_index, float quality) {
  uint32_t place = count_;
  for (uint32_t i = 0; i < count_ && place == count_; ++i)
    if (matches_[i].point_index == point_index) place = i;
  if (place == matches_.size()) {
    place = 0;
    for (uint32_t i = 1; i < count_; ++i)
      if (matches_[i].age > matches_[place].age) place = i;
  }
  if (place == count_) ++count_;
  const double depth_variance = lifted.along_m * lifted.along_m,
               rest_variance = lifted.sideways_m * lifted.sideways_m;
  OldMatch &match = matches_[place];
  match = {lifted, lifted.view(), depth_variance, rest_variance, point_index, quality, 0};
  match.lifted.centre_m.setZero();  // later frames look at it from elsewhere anyway
}

void History::driftOfEarlier(double *turn_sigma_rad, double *shift_sigma_m) const {
  uint32_t earlier = 0;
  Drift sum;
  for (const OldMatch &match : matches()) {
    earlier += match.age > 0;
    sum.turn_variance += since_[match.age].turn_variance;
    sum.shift_variance += since_[match.age].shift_variance;
  }
  *turn_sigma_rad = earlier ? sqrtOf(sum.turn_variance / earlier) : 0;
  *shift_sigma_m = earlier ? sqrtOf(sum.shift_variance / earlier) : 0;
}

uint32_t History::frames() const {
  static_assert(tuning::kMostFramesTogether < 64, "a bit an age");
  uint64_t seen = 0;
  for (const OldMatch &match : matches()) seen |= uint64_t{1} << match.age;
  uint32_t frames = 0;
  for (; seen; seen &= seen - 1) ++frames;
  return frames;
}

}  // namespace sphc
