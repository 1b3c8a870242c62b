// The strongest extrema of an image, in fixed memory, and a choice among them that covers the image.
#pragma once
#include <cstdint>

#include "runtime/base/arena.h"
#include "runtime/stages/features/config.h"

namespace sphc {

// A refined extremum, in the pixels of its octave: array index coordinates, pixel 0 at 0.
struct Candidate {
  float response;
  float x, y;
  float layer;  // continuous: level + offset
  int16_t octave;
  int16_t level;  // 1 .. kScales
};

// A total order, so that the result does not depend on the order of insertion: stronger first, then by place.
bool isBefore(const Candidate &a, const Candidate &b);

class CandidateList {
 public:
  static void layout(const FeatureConfig &config, Arena &scratch, CandidateList *out);

  void clear() { size_ = 0; }
  // Keeps the strongest of all that were pushed.
  void push(const Candidate &candidate);
  // Sorts, removes duplicates and keeps at most `limit`: first the strongest of every grid cell up to the cell's
  // quota, then the strongest of the rest.  Strongest first.
  Span<Candidate> choose(uint32_t limit, const FeatureConfig &config);

 private:
  void removeDuplicates();

  Span<Candidate> items_;  // a heap with the weakest on top while pushing
  size_t size_ = 0;
};

}  // namespace sphc
