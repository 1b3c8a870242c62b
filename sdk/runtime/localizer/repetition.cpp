#include "runtime/localizer/repetition.h"

#include <algorithm>

#include "runtime/stages/match/distance.h"

namespace sphc {

using namespace tuning;

namespace {

constexpr uint32_t kGrain = 4096;  // comparisons between two looks at the clock

bool areEqual(const Vector3 &a, const Vector3 &b, double tolerance_m) {
  return (a - b).squaredNorm() < tolerance_m * tolerance_m;
}

double nearestWhole(double x) { return x < 0 ? static_cast<int>(x - 0.5) : static_cast<int>(x + 0.5); }

}  // namespace

void Repetition::layout(uint32_t max_keypoints, Arena &scratch, Repetition *repetition) {
  const Span<Vector3> moves = scratch.take<Vector3>("localizer.moves", std::min(max_keypoints, kAskedForLike));
  if (repetition) repetition->found_m_ = moves;
}

bool Repetition::look(const FrontEnd &front, const Deadline &deadline) {
  front_ = &front;
  looked_at_ = std::min(front.liftedCount(), static_cast<uint32_t>(found_m_.size()));
  found_ = 0;
  moves_m_.clear();
  Watch watch(deadline, kGrain);
  for (uint32_t i = 0; i < looked_at_; ++i) {
    if (watch.passed(looked_at_)) return false;
    if (moveToLike(i, &found_m_[found_])) ++found_;
  }
  Vector3 commonest_m;
  while (!moves_m_.full() && findCommonest(&commonest_m) >= kFewestMoves) {
    moves_m_.push(commonest_m);
    keepOthersThan(commonest_m);
  }
  return true;
}

// To the keypoint that resembles this one most, but not to one at the same place.
bool Repetition::moveToLike(uint32_t keypoint, Vector3 *move_m) const {
  uint32_t least = kMostDistance2OfLike;
  const Vector3 &here_m = front_->lifted()[keypoint].point_m;
  for (uint32_t other = 0; other < looked_at_; ++other) {
    const Vector3 &there_m = front_->lifted()[other].point_m;
    if (areEqual(here_m, there_m, kLeastMoveM)) continue;
    const uint32_t d2 = distance2(front_->descriptors()[keypoint], front_->descriptors()[other]);
    if (d2 >= least) continue;
    least = d2;
    *move_m = there_m - here_m;
  }
  return least < kMostDistance2OfLike;
}

bool Repetition::repeats(uint32_t keypoint) const {
  Vector3 move_m;
  return moveToLike(keypoint, &move_m);
}

// The mean of the moves that are most alike, and how many they are.
uint32_t Repetition::findCommonest(Vector3 *commonest_m) const {
  uint32_t most = 0;
  for (const Vector3 &move_m : found_m_.first(found_)) {
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
    const double times = nearestWhole(found_m_[i].dot(move_m) / move_m.squaredNorm());
    if (!areEqual(found_m_[i], times * move_m, 2 * kSameMoveM)) found_m_[kept++] = found_m_[i];
  }
  found_ = kept;
}

}  // namespace sphc
