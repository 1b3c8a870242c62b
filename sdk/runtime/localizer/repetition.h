// Does what is seen repeat itself?  On a carpet or on tiles a pose that is off by the period of the pattern has
// nearly as many inliers as the right one; what does not repeat tells the two apart.
#pragma once
#include "runtime/base/arena.h"
#include "runtime/base/deadline.h"
#include "runtime/base/fixed_vector.h"
#include "runtime/localizer/front_end.h"
#include "runtime/localizer/tuning.h"

namespace sphc {

class Repetition {
 public:
  static void layout(uint32_t max_keypoints, Arena &scratch, Repetition *repetition);

  // Finds the moves that take many of the frame's strongest keypoints with depth to their like.  False where there
  // is no time for it.  The frame is borrowed.
  bool look(const FrontEnd &front, const Deadline &deadline);

  // In the camera's frame, metres, the commonest first; one of each pair of opposite moves, no multiple of another.
  Span<const Vector3> moves_m() const { return {moves_m_.begin(), moves_m_.size()}; }
  // Is there the like of this keypoint, which has depth, elsewhere in the frame?
  bool repeats(uint32_t keypoint) const;

 private:
  bool moveToLike(uint32_t keypoint, Vector3 *move_m) const;
  uint32_t findCommonest(Vector3 *commonest_m) const;
  void keepOthersThan(const Vector3 &move_m);

  const FrontEnd *front_ = nullptr;
  uint32_t looked_at_ = 0;  // keypoints
  Span<Vector3> found_m_;   // in scratch: a move of each keypoint that has its like
  uint32_t found_ = 0;
  FixedVector<Vector3, tuning::kMostMoves> moves_m_;
};

}  // namespace sphc
