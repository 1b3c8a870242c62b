// The strongest extrema of an image, in fixed memory, and a choice among them that covers the image.
#pragma once
#include <cstdint>

#include "runtime/base/arena.h"
#include "runtime/stages/features/config.h"

namespace sphc {

// A refined extremum, in the pixels of its octave: array index coordinates, pixel 0 at 0.
struct Candidate {
  float response;
  float strength;  // response over the noise that white pixel noise leaves at this scale, up to a factor
  float x, y;
  float layer;  // continuous: level + offset
  int16_t octave;
  int16_t level;  // 1 .. kScales
};

class CandidateList {
 public:
  static void layout(const FeatureConfig &config, Arena &scratch, CandidateList *out);

  void clear() { size_ = 0; }
  // Keeps the strongest of all that were pushed.
  void push(const Candidate &candidate);
  // Sorts, removes duplicates and keeps at most `limit`: first the strongest of every grid cell up to the cell's
  // quota, then the strongest of the rest.  Highest response first.
  Span<Candidate> choose(uint32_t limit, const FeatureConfig &config);

 private:
  void removeDuplicates();
  Candidate *chooseByCell(uint32_t limit, const FeatureConfig &config);

  Span<Candidate> items_;  // a heap with the weakest on top while pushing
  size_t size_ = 0;
};

}  // namespace sphc
