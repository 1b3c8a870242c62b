#include "runtime/stages/features/candidates.h"

#include <algorithm>

namespace sphc {
namespace {

constexpr int32_t kCellsAcross = 8, kCellsDown = 6;
// Room for extrema over the keypoints finally wanted: enough that quotas have something to choose from.
constexpr size_t kCandidatesPerKeypoint = 6, kFewestCandidates = 1024;

bool samePlace(const Candidate &a, const Candidate &b) {
  return a.octave == b.octave && a.x == b.x && a.y == b.y && a.layer == b.layer;
}

// Cells of the grid are counted in octave pixels, so that first_octave does not matter here.
uint32_t cellOf(const Candidate &c, const FeatureConfig &config) {
  const float scale = static_cast<float>(1 << c.octave) * (config.first_octave < 0 ? 0.5f : 1.0f);
  const int32_t column = static_cast<int32_t>(c.x * scale) * kCellsAcross / config.width;
  const int32_t row = static_cast<int32_t>(c.y * scale) * kCellsDown / config.height;
  return static_cast<uint32_t>(std::min(row, kCellsDown - 1) * kCellsAcross + std::min(column, kCellsAcross - 1));
}

}  // namespace

bool isBefore(const Candidate &a, const Candidate &b) {
  if (a.response != b.response) return a.response > b.response;
  if (a.octave != b.octave) return a.octave < b.octave;
  if (a.y != b.y) return a.y < b.y;
  if (a.x != b.x) return a.x < b.x;
  return a.layer < b.layer;
}

void CandidateList::layout(const FeatureConfig &config, Arena &scratch, CandidateList *out) {
  const size_t capacity = std::max(kCandidatesPerKeypoint * config.max_keypoints, kFewestCandidates);
  const Span<Candidate> items = scratch.take<Candidate>("features.candidates", capacity);
  if (out) out->items_ = items;
}

void CandidateList::push(const Candidate &candidate) {
  Candidate *begin = items_.data();
  if (size_ < items_.size()) {
    begin[size_++] = candidate;
    if (size_ == items_.size()) std::make_heap(begin, begin + size_, isBefore);
    return;
  }
  if (!isBefore(candidate, begin[0])) return;
  std::pop_heap(begin, begin + size_, isBefore);
  begin[size_ - 1] = candidate;
  std::push_heap(begin, begin + size_, isBefore);
}

// Two extrema of the samples may refine to the same point; sorted, they are neighbours.
void CandidateList::removeDuplicates() {
  Candidate *begin = items_.data();
  size_ = static_cast<size_t>(std::unique(begin, begin + size_, samePlace) - begin);
}

Span<Candidate> CandidateList::choose(uint32_t limit, const FeatureConfig &config) {
  Candidate *begin = items_.data(), *end = begin + size_;
  std::sort(begin, end, isBefore);
  removeDuplicates();
  end = begin + size_;
  if (size_ <= limit) return items_.first(size_);

  const float share = static_cast<float>(limit) / (kCellsAcross * kCellsDown);
  const uint32_t quota = static_cast<uint32_t>(config.cell_quota * share) + 1;
  uint32_t in_cell[kCellsAcross * kCellsDown] = {};
  // Those within their cell's quota, and then those beyond it; each part stays in order.
  Candidate *chosen = begin;
  for (Candidate *c = begin; c != end && chosen != begin + limit; ++c) {
    if (in_cell[cellOf(*c, config)]++ >= quota) continue;
    // Not a swap: rotating would keep all in order but costs quadratic time; the passed over are sorted again
    // below.
    std::swap(*chosen++, *c);
  }
  if (chosen != begin + limit) std::sort(chosen, end, isBefore);
  std::sort(begin, begin + limit, isBefore);
  return items_.first(limit);
}

}  // namespace sphc
