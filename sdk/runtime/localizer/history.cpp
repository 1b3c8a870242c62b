#include "runtime/localizer/history.h"

namespace sphc {
namespace {

constexpr uint16_t kMostFrames = 60;
constexpr double kVague_m = 0.06;  // sideways sigma beyond which a match is worth nothing

}  // namespace

void History::layout(uint32_t capacity, Arena &state, History *history) {
  const Span<OldMatch> matches = state.take<OldMatch>("localizer.history", capacity);
  if (history) history->matches_ = matches;
}

void History::advance(const Rigid &now_from_before, double rotation_sigma_rad, double translation_sigma_m) {
  uint32_t kept = 0;
  for (uint32_t i = 0; i < count_; ++i) {
    OldMatch match = matches_[i];
    LiftedPoint &lifted = match.lifted;
    const Vector3 old_view = now_from_before.rotation * lifted.point_m.normalized();
    lifted.point_m = now_from_before * lifted.point_m;
    // Its depth error lay along the old viewing ray: what of it now lies across the new one adds to the error
    // there.
    const double cosine = old_view.dot(lifted.point_m.normalized());
    const double sine2 = cosine < 1 ? 1 - cosine * cosine : 0;
    const double turned = rotation_sigma_rad * lifted.point_m.norm();
    const double drift2 = turned * turned + translation_sigma_m * translation_sigma_m;
    const double along2 = lifted.along_m * lifted.along_m;
    lifted.sideways_m = sqrtOf(lifted.sideways_m * lifted.sideways_m + along2 * sine2 + drift2);
    lifted.along_m = sqrtOf(along2 + drift2);
    if (++match.age <= kMostFrames && lifted.sideways_m < kVague_m) matches_[kept++] = match;
  }
  count_ = kept;
}

void History::add(const LiftedPoint &lifted, uint32_t map_index, float quality) {
  uint32_t place = count_;
  for (uint32_t i = 0; i < count_ && place == count_; ++i)
    if (matches_[i].map_index == map_index) place = i;
  if (place == matches_.size()) {
    place = 0;
    for (uint32_t i = 1; i < count_; ++i)
      if (matches_[i].age > matches_[place].age) place = i;
  }
  if (place == count_) ++count_;
  matches_[place] = {lifted, map_index, quality, 0};
}

uint32_t History::frames() const {
  uint64_t seen = 0;  // a bit an age
  for (const OldMatch &match : matches()) seen |= uint64_t{1} << match.age;
  uint32_t frames = 0;
  for (; seen; seen &= seen - 1) ++frames;
  return frames;
}

}  // namespace sphc
