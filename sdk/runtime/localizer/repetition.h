// Does what is seen repeat itself?  On a carpet or on tiles a pose that is off by the period of the pattern has
// nearly as many inliers as the right one; what does not repeat tells the two apart.
#pragma once
#include "runtime/base/arena.h"
#include "runtime/base/deadline.h"
#include "runtime/base/fixed_vector.h"
#include "runtime/base/parallel.h"
#include "runtime/localizer/front_end.h"
#include "runtime/localizer/tuning.h"

namespace sphc {

class Repetition {
 public:
  // Of `parallel` the number of pieces counts.
  static void layout(uint32_t max_keypoints, const Parallel &parallel, Arena &scratch, Repetition *repetition);
  void setParallel(const Parallel &parallel) { parallel_ = parallel; }

  // Finds the moves that take many of the frame's strongest keypoints with depth to their like.  False where there
  // is no time for it.  The frame is borrowed.
  bool look(const FrontEnd &front, const Deadline &deadline);

  // In the camera's frame, metres, the commonest first, each of a direction of its own.
  Span<const Vector3> moves_m() const { return {moves_m_.begin(), moves_m_.size()}; }
  // Is there the like of this keypoint, which has depth, elsewhere in the frame?
  bool repeats(uint32_t keypoint) const;

 private:
  // The keypoint that resembles one most, of those that do not lie at the same place.
  struct Like {
    uint32_t distance2 = UINT32_MAX, keypoint = 0;

    // Of equals the first keypoint stays.
    void see(const Like &other) {
      const bool is_nearer = other.distance2 < distance2;
      if (is_nearer || (other.distance2 == distance2 && other.keypoint < keypoint)) *this = other;
    }
  };
  // A move, and how many are like it.
  struct Common {
    Vector3 move_m;
    uint32_t count = 0;
  };
  uint32_t compare(uint32_t a, uint32_t b) const;
  bool findLikes(const Deadline &deadline);
  bool compareRows(uint32_t piece, Watch *watch);
  void listMoves();
  bool findCommonest(const Deadline &deadline, Common *commonest) const;
  bool findCommonestOf(Part moves, Watch *watch, Common *commonest) const;
  void keepOthersThan(const Vector3 &move_m);

  const FrontEnd *front_ = nullptr;
  uint32_t looked_at_ = 0;  // keypoints
  // In scratch.
  Span<Like> likes_;       // of each keypoint that was looked at; and again for each piece but the first
  Span<Vector3> found_m_;  // of each that has its like the move to it
  uint32_t found_ = 0;
  FixedVector<Vector3, tuning::kMostMoves> moves_m_;
  Parallel parallel_;
};

}  // namespace sphc
