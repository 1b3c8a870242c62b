#include "runtime/stages/features/candidates.h"

#include <algorithm>

namespace sphc {
namespace {

constexpr int32_t kCellsAcross = 8, kCellsDown = 6;
// Room for extrema over the keypoints finally wanted: enough that quotas have something to choose from.
constexpr size_t kCandidatesPerKeypoint = 4, kFewestCandidates = 1024;
constexpr float kSamePlace = 0.5f;   // standard deviations
constexpr float kSameScale = 1.28f;  // a little over the step from scale to scale

// Total orders, so that no result depends on the order of insertion.
bool isPlacedBefore(const Candidate &a, const Candidate &b) {
  if (a.octave != b.octave) return a.octave < b.octave;
  if (a.y != b.y) return a.y < b.y;
  if (a.x != b.x) return a.x < b.x;
  return a.layer < b.layer;
}
bool isStronger(const Candidate &a, const Candidate &b) {
  return a.strength != b.strength ? a.strength > b.strength : isPlacedBefore(a, b);
}
bool hasHigherResponse(const Candidate &a, const Candidate &b) {
  return a.response != b.response ? a.response > b.response : isPlacedBefore(a, b);
}

// Pixels of the first octave in one of the candidate's.
float pixelSize(const Candidate &c) { return static_cast<float>(1 << c.octave); }
float sigmaOf(const Candidate &c) { return c.strength / c.response; }

bool isHigher(const Candidate &a, const Candidate &b) {
  const float y = a.y * pixelSize(a), other_y = b.y * pixelSize(b);
  return y != other_y ? y < other_y : isPlacedBefore(a, b);
}

// One structure found twice: by neighbouring scales, in particular on both sides of an octave's end, or by two
// samples that refine to the same point.
bool isSameStructure(const Candidate &a, const Candidate &b) {
  const float smaller = std::min(sigmaOf(a), sigmaOf(b)), larger = std::max(sigmaOf(a), sigmaOf(b));
  if (larger > kSameScale * smaller) return false;
  const float dx = a.x * pixelSize(a) - b.x * pixelSize(b), dy = a.y * pixelSize(a) - b.y * pixelSize(b);
  return dx * dx + dy * dy < kSamePlace * kSamePlace * smaller * smaller;
}

// Cells of the grid are counted in octave pixels, so that first_octave does not matter here.
uint32_t cellOf(const Candidate &c, const FeatureConfig &config) {
  const float scale = static_cast<float>(1 << c.octave) * (config.first_octave < 0 ? 0.5f : 1.0f);
  const int32_t column = static_cast<int32_t>(c.x * scale) * kCellsAcross / config.width;
  const int32_t row = static_cast<int32_t>(c.y * scale) * kCellsDown / config.height;
  return static_cast<uint32_t>(std::min(row, kCellsDown - 1) * kCellsAcross + std::min(column, kCellsAcross - 1));
}

}  // namespace

void CandidateList::layout(const FeatureConfig &config, Arena &scratch, CandidateList *out) {
  const size_t capacity = std::max(kCandidatesPerKeypoint * config.max_keypoints, kFewestCandidates);
  const Span<Candidate> items = scratch.take<Candidate>("features.candidates", capacity);
  if (out) out->items_ = items;
}

void CandidateList::push(const Candidate &candidate) {
  Candidate *begin = items_.data();
  if (size_ < items_.size()) {
    begin[size_++] = candidate;
    if (size_ == items_.size()) std::make_heap(begin, begin + size_, isStronger);
    return;
  }
  if (!isStronger(candidate, begin[0])) return;
  std::pop_heap(begin, begin + size_, isStronger);
  begin[size_ - 1] = candidate;
  std::push_heap(begin, begin + size_, isStronger);
}

// Whoever has a stronger twin goes, whether or not that one stays: so the order of looking does not matter.
void CandidateList::removeTwins() {
  Candidate *begin = items_.data(), *end = begin + size_;
  std::sort(begin, end, isHigher);
  for (Candidate *a = begin; a != end; ++a) {
    const float last_y = a->y * pixelSize(*a) + kSamePlace * sigmaOf(*a);
    for (Candidate *b = a + 1; b != end && b->y * pixelSize(*b) < last_y; ++b) {
      if (isSameStructure(*a, *b)) (isStronger(*a, *b) ? b : a)->is_twin = true;
    }
  }
  size_ = static_cast<size_t>(std::remove_if(begin, end, [](const Candidate &c) { return c.is_twin; }) - begin);
}

// Moves the strongest that fit the cells' quotas to the front, in order; returns the end of their part.
Candidate *CandidateList::chooseByCell(uint32_t limit, const FeatureConfig &config) {
  const float share = static_cast<float>(limit) / (kCellsAcross * kCellsDown);
  const uint32_t quota = static_cast<uint32_t>(config.cell_quota * share) + 1;
  uint32_t in_cell[kCellsAcross * kCellsDown] = {};
  Candidate *chosen = items_.data();
  for (Candidate *c = items_.data(); c != items_.data() + size_ && chosen != items_.data() + limit; ++c) {
    if (in_cell[cellOf(*c, config)]++ < quota) std::swap(*chosen++, *c);
  }
  return chosen;
}

Span<Candidate> CandidateList::choose(uint32_t limit, const FeatureConfig &config) {
  Candidate *begin = items_.data();
  removeTwins();
  std::sort(begin, begin + size_, isStronger);
  if (size_ > limit) {
    std::sort(chooseByCell(limit, config), begin + size_, isStronger);
    size_ = limit;
  }
  std::sort(begin, begin + size_, hasHigherResponse);
  return items_.first(size_);
}

}  // namespace sphc
