// The strongest extrema of an image, in fixed memory, and a choice among them that covers the image.
#pragma once
#include <cstdint>

#include "runtime/base/arena.h"
#include "runtime/stages/features/config.h"
#include "runtime/stages/features/radix_sort.h"

namespace sphc {

// A refined extremum, in the pixels of its octave: array index coordinates, pixel 0 at 0.
struct Candidate {
  float response;
  float strength;  // response times standard deviation in pixels of the first octave
  float x, y;
  float layer;  // continuous: level + offset
  int8_t octave;
  int8_t level;            // 1 .. kScales
  bool is_near_duplicate;  // a stronger one stands for the same structure
};

class CandidateList {
  // Where a candidate lies, in pixels of the first octave.
  struct Place {
    float x, y, sigma;
    uint32_t candidate;
  };

 public:
  static void layout(const FeatureConfig &config, Arena &scratch, CandidateList *out);

  // A list that only collects: room for `more` than are kept at most, and for no choice.
  static void layoutPiece(const FeatureConfig &config, size_t more, Arena &scratch, CandidateList *out);
  // Can so many be pushed, and all still be there?
  bool hasRoom(size_t count) const { return size_ + count < items_.size(); }
  // Pushes all to another list, in their order.
  void moveTo(CandidateList *other);

  void clear() { size_ = 0; }
  // Keeps the strongest of all that were pushed, several for each keypoint wanted.
  void push(const Candidate &candidate) {
    items_[size_++] = candidate;
    if (size_ == items_.size()) cut();
  }
  size_t size() const { return size_; }
  // Removes near-duplicates and keeps at most `limit`, which max_keypoints bounds: first the strongest of every
  // grid cell up to the cell's quota, then the strongest of the rest.  Highest response first.
  Span<Candidate> choose(const FeatureConfig &config, size_t limit);

 private:
  static size_t keptOf(const FeatureConfig &config);
  void cut();
  void listPlaces();
  void markNearDuplicates();
  static bool isSameStructure(const Place &a, const Place &b);
  // Of those that are no near-duplicates: by strength, highest first, into ranks_.  Returns how many.
  size_t rankByStrength();
  size_t chooseByCell(size_t ranked, const FeatureConfig &config, size_t limit);

  Span<Candidate> items_, chosen_;
  Span<SortKey> ranks_, spare_;
  Span<Place> places_;
  size_t size_ = 0, kept_ = 0;
};

}  // namespace sphc
