// Were frames a moment ago ambiguous?  What is seen now then repeats too, though in one frame nothing shows it.
#pragma once
#include <cstdint>

namespace sphc {

class RecentAmbiguity {
 public:
  // Before each frame; a time that does not grow, or by more than Tracker::kForgetNs, begins anew.
  void advance(int64_t time_ns);
  // After it.
  void add(bool is_ambiguous);
  // Of the frames before this one.
  bool isSeen() const;
  void reset() { ambiguous_ = frames_ = 0; }

 private:
  int64_t time_ns_ = 0;
  double ambiguous_ = 0, frames_ = 0;  // sums of weights, which fall with age
};

}  // namespace sphc
