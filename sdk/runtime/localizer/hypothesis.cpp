#include "runtime/localizer/hypothesis.h"

namespace sphc {

namespace {

// Once: it takes half a kilobyte where it is inlined three times.
[[gnu::noinline]] void copy(const Hypothesis &from, Hypothesis *to) { *to = from; }

}  // namespace

void MatchSet::layout(uint32_t max_keypoints, Arena &scratch, MatchSet *matches) {
  MatchSet discarded;  // receives empty spans while measuring
  MatchSet &m = matches ? *matches : discarded;
  m.matches_ = scratch.take<Match>("localizer.matches", max_keypoints);
  // of this frame, and of earlier ones
  m.correspondences_ = scratch.take<Correspondence>("localizer.correspondences", size_t{2} * max_keypoints);
}

void MatchSet::assign(uint32_t count, const FrontEnd &front, const MapView &map) {
  for (uint32_t i = 0; i < count; ++i) correspondences_[i] = correspondenceOf(matches_[i], front, map);
  match_count_ = count_ = count;
}

void Hypothesis::begin(uint32_t map_slot, uint32_t frame_count) {
  Hypothesis fresh;
  fresh.tried = true;
  fresh.map = map_slot;
  fresh.frames = frame_count;
  challenge(fresh);
}

void Hypothesis::challenge(const Hypothesis &other) {
  const MatchSet own = matched;
  copy(other, this);
  matched = own;
  matched.clear();
}

void swap(Hypothesis &a, Hypothesis &b) {
  Hypothesis kept;
  copy(a, &kept);
  copy(b, &a);
  copy(kept, &b);
}

bool areNear(const Rigid &a, const Rigid &b, const tuning::PoseBounds &bounds) {
  const Vector3 shift_m = a.inverse().translation_m - b.inverse().translation_m;
  return shift_m.norm() < bounds.most_shift_m &&
         rotationAngle(a.rotation * b.rotation.transpose()) < bounds.most_turn_rad;
}

Correspondence correspondenceOf(const Match &match, const FrontEnd &front, const MapView &map) {
  return {front.lifted()[match.query], directionOf(map, match.point_index),
          1.0f - static_cast<float>(match.distance2) / static_cast<float>(match.second2 + 1)};
}

Vector3 directionOf(const MapView &map, uint32_t point_index) {
  const Direction d = map.direction(point_index);
  return Vector3(static_cast<double>(d.x), static_cast<double>(d.y), static_cast<double>(d.z));
}

}  // namespace sphc
