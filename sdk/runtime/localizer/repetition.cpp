#include "runtime/localizer/repetition.h"

#include <algorithm>

#include "runtime/stages/match/distance.h"

namespace sphc {

using namespace tuning;

namespace {

constexpr uint32_t kGrain = 2048;  // comparisons between two looks at the clock

bool areEqual(const Vector3 &a, const Vector3 &b, double tolerance_m) {
  return (a - b).squaredNorm() < tolerance_m * tolerance_m;
}

}  // namespace

void Repetition::layout(uint32_t max_keypoints, const Parallel &parallel, Arena &scratch, Repetition *repetition) {
  Repetition discarded;  // receives empty spans while measuring
  Repetition &r = repetition ? *repetition : discarded;
  const uint32_t count = std::min(max_keypoints, kAskedForLike);
  r.likes_ = scratch.take<Like>("localizer.likes", size_t{count} * parallel.pieces);
  r.found_m_ = scratch.take<Vector3>("localizer.moves", count);
}

bool Repetition::look(const FrontEnd &front, const Deadline &deadline) {
  front_ = &front;
  looked_at_ = std::min(front.liftedCount(), static_cast<uint32_t>(found_m_.size()));
  moves_m_.clear();
  if (!findLikes(deadline)) return false;
  listMoves();
  bool in_time = true;
  while (in_time && !moves_m_.full()) {
    Common commonest;
    in_time = findCommonest(deadline, &commonest);
    if (!in_time || commonest.count < kFewestMoves) break;
    moves_m_.push(commonest.move_m);
    keepOthersThan(commonest.move_m);
  }
  return in_time;
}

// Of what several pieces of the pairs say.
bool Repetition::findLikes(const Deadline &deadline) {
  const uint32_t pieces = parallel_.pieces;
  const bool in_time = parallel_.allOf(pieces, [&](uint32_t i) {
    Watch watch(deadline, kGrain);
    return compareRows(i, &watch);
  });
  for (uint32_t i = 1; i < pieces; ++i)
    for (uint32_t k = 0; k < looked_at_; ++k) likes_[k].see(likes_[i * found_m_.size() + k]);
  return in_time;
}

// Keypoints that are `pieces` apart, each with those before it: later ones have more of them.
bool Repetition::compareRows(uint32_t piece, Watch *watch) {
  Like *likes = likes_.data() + piece * found_m_.size();
  std::fill_n(likes, looked_at_, Like());
  for (uint32_t i = piece; i < looked_at_; i += parallel_.pieces) {
    if (watch->passed(i)) return false;
    for (uint32_t other = 0; other < i; ++other) {
      const uint32_t d2 = compare(i, other);
      if (d2 < likes[i].distance2) likes[i] = {d2, other};
      if (d2 < likes[other].distance2) likes[other] = {d2, i};
    }
  }
  return true;
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

// The mean of the moves that are most alike, and how many they are; of equally many the first.
bool Repetition::findCommonest(const Deadline &deadline, Common *commonest) const {
  Common found[Parallel::kMostPieces];
  const uint32_t pieces = parallel_.pieces;
  const bool in_time = parallel_.allOf(pieces, [&](uint32_t i) {
    Watch watch(deadline, kGrain);
    return findCommonestOf(partOf(found_, pieces, i), &watch, &found[i]);
  });
  for (uint32_t i = 0; i < pieces; ++i)
    if (found[i].count > commonest->count) *commonest = found[i];
  return in_time;
}

bool Repetition::findCommonestOf(Part moves, Watch *watch, Common *commonest) const {
  for (size_t i = moves.first; i < moves.end; ++i) {
    if (watch->passed(found_)) return false;
    const Vector3 &move_m = found_m_[i];
    uint32_t near = 0;
    Vector3 sum_m = Vector3::Zero();
    for (const Vector3 &other : found_m_.first(found_)) {
      const Vector3 other_m = move_m.dot(other) < 0 ? Vector3(-other) : other;
      if (!areEqual(move_m, other_m, kSameMoveM)) continue;
      sum_m += other_m;
      ++near;
    }
    if (near > commonest->count) *commonest = {sum_m / near, near};
  }
  return true;
}

// Of the moves that were found those of another direction: two tiles on and three are the same pattern.
void Repetition::keepOthersThan(const Vector3 &move_m) {
  uint32_t kept = 0;
  for (uint32_t i = 0; i < found_; ++i) {
    const double times = found_m_[i].dot(move_m) / move_m.squaredNorm();
    if (!areEqual(found_m_[i], times * move_m, 2 * kSameMoveM)) found_m_[kept++] = found_m_[i];
  }
  found_ = kept;
}

}  // namespace sphc
