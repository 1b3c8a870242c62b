// Were frames a moment ago ambiguous?  What is seen now then repeats too, though in one frame nothing shows it.
#pragma once
#include <cstdint>

#include "runtime/localizer/tuning.h"

namespace sphc {

class RecentAmbiguity {
 public:
  // Before each frame; a time that does not grow begins anew.
  void advance(int64_t time_ns);
  // After it.
  void add(bool is_ambiguous) {
    ambiguous_ += is_ambiguous;
    frames_ += 1;
  }
  // Of the frames before this one.
  bool isSeen() const {
    return ambiguous_ >= tuning::kFewestAmbiguous && ambiguous_ >= tuning::kShareAmbiguous * frames_;
  }
  void reset() { ambiguous_ = frames_ = 0; }

 private:
  int64_t time_ns_ = 0;
  double ambiguous_ = 0, frames_ = 0;  // sums of weights, which fall with age
};

}  // namespace sphc
