#include "runtime/localizer/repetition.h"

#include <algorithm>

#include "runtime/base/elementary.h"
#include "runtime/stages/match/distance.h"

namespace sphc {

using namespace tuning;

namespace {

constexpr uint32_t kGrain = 2048;  // comparisons between two looks at the clock

bool areEqual(const Vector3 &a, const Vector3 &b, double tolerance_m) {
  return (a - b).squaredNorm() < tolerance_m * tolerance_m;
}

}  // namespace

void Repetition::layout(uint32_t max_keypoints, Arena &scratch, Repetition *repetition) {
  Repetition discarded;  // receives empty spans while measuring
  Repetition &r = repetition ? *repetition : discarded;
  const uint32_t count = std::min(max_keypoints, kAskedForLike);
  r.likes_ = scratch.take<Like>("localizer.likes", count);
  r.found_m_ = scratch.take<Vector3>("localizer.moves", count);
}

bool Repetition::look(const FrontEnd &front, const Deadline &deadline) {
  front_ = &front;
  looked_at_ = std::min(front.liftedCount(), static_cast<uint32_t>(likes_.size()));
  moves_m_.clear();
  Watch watch(deadline, kGrain);
  for (uint32_t i = 0; i < looked_at_; ++i) {
    if (watch.passed(i)) return false;
    likes_[i] = {};
    for (uint32_t other = 0; other < i; ++other) {
      const uint32_t d2 = compare(i, other);
      if (d2 < likes_[i].distance2) likes_[i] = {d2, other};
      if (d2 < likes_[other].distance2) likes_[other] = {d2, i};
    }
  }
  listMoves();
  Vector3 commonest_m;
  while (!moves_m_.full() && findCommonest(&watch, &commonest_m) >= kFewestMoves) {
    moves_m_.push(commonest_m);
    keepOthersThan(commonest_m);
  }
  return !watch.hasPassed();
}

// Of the descriptors of two keypoints at different places.
uint32_t Repetition::compare(uint32_t a, uint32_t b) const {
  if (areEqual(front_->lifted()[a].point_m, front_->lifted()[b].point_m, kLeastMoveM)) return UINT32_MAX;
  return distance2(front_->descriptors()[a], front_->descriptors()[b]);
}

void Repetition::listMoves() {
  found_ = 0;
  for (uint32_t i = 0; i < looked_at_; ++i)
    if (likes_[i].distance2 < kMostDistance2OfLike)
      found_m_[found_++] = front_->lifted()[likes_[i].keypoint].point_m - front_->lifted()[i].point_m;
}

bool Repetition::repeats(uint32_t keypoint) const {
  if (keypoint < looked_at_) return likes_[keypoint].distance2 < kMostDistance2OfLike;
  for (uint32_t other = 0; other < looked_at_; ++other)
    if (compare(keypoint, other) < kMostDistance2OfLike) return true;
  return false;
}

// The mean of the moves that are most alike, and how many they are.
uint32_t Repetition::findCommonest(Watch *watch, Vector3 *commonest_m) const {
  uint32_t most = 0;
  for (const Vector3 &move_m : found_m_.first(found_)) {
    if (watch->passed(found_)) return 0;
    uint32_t near = 0;
    Vector3 sum_m = Vector3::Zero();
    for (const Vector3 &other : found_m_.first(found_)) {
      const Vector3 other_m = move_m.dot(other) < 0 ? Vector3(-other) : other;
      if (!areEqual(move_m, other_m, kSameMoveM)) continue;
      sum_m += other_m;
      ++near;
    }
    if (near <= most) continue;
    most = near;
    *commonest_m = sum_m / near;
  }
  return most;
}

// Of the moves that were found those that are no multiple of this one.
void Repetition::keepOthersThan(const Vector3 &move_m) {
  uint32_t kept = 0;
  for (uint32_t i = 0; i < found_; ++i) {
    const double times = floorOf(found_m_[i].dot(move_m) / move_m.squaredNorm() + 0.5);
    if (!areEqual(found_m_[i], times * move_m, 2 * kSameMoveM)) found_m_[kept++] = found_m_[i];
  }
  found_ = kept;
}

}  // namespace sphc
