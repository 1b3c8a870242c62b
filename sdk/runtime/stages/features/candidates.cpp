#include "runtime/stages/features/candidates.h"

#include <algorithm>

namespace sphc {
namespace {

constexpr int32_t kCellsAcross = 8, kCellsDown = 6;
// Extrema kept for each keypoint finally wanted: enough that quotas have something to choose from.  Twice as many
// have room, so that a cut is rare.
constexpr size_t kCandidatesPerKeypoint = 3, kFewestCandidates = 768;
constexpr float kSamePlace = 0.5f;   // standard deviations
constexpr float kSameScale = 1.28f;  // a little over the step from scale to scale

// Pixels of the first octave in one of the candidate's.
float pixelSize(const Candidate &c) { return static_cast<float>(1 << c.octave); }

// Cells of the grid are counted in octave pixels, so that first_octave does not matter here.
uint32_t cellOf(const Candidate &c, const FeatureConfig &config) {
  const float scale = static_cast<float>(1 << c.octave) * (config.first_octave < 0 ? 0.5f : 1.0f);
  const int32_t column = static_cast<int32_t>(c.x * scale) * kCellsAcross / config.width;
  const int32_t row = static_cast<int32_t>(c.y * scale) * kCellsDown / config.height;
  return static_cast<uint32_t>(std::min(row, kCellsDown - 1) * kCellsAcross + std::min(column, kCellsAcross - 1));
}

}  // namespace

size_t CandidateList::keptOf(const FeatureConfig &config) {
  return std::max<size_t>(kCandidatesPerKeypoint * config.max_keypoints, kFewestCandidates);
}

void CandidateList::layoutPiece(const FeatureConfig &config, size_t more, Arena &scratch, CandidateList *out) {
  const Span<Candidate> items = scratch.take<Candidate>("features.candidates", keptOf(config) + more);
  if (out) out->items_ = items;
}

void CandidateList::moveTo(CandidateList *other) {
  for (size_t i = 0; i < size_; ++i) other->push(items_[i]);
  clear();
}

void CandidateList::layout(const FeatureConfig &config, Arena &scratch, CandidateList *out) {
  CandidateList measured;
  CandidateList &self = out ? *out : measured;
  self.kept_ = keptOf(config);
  self.items_ = scratch.take<Candidate>("features.candidates", 2 * self.kept_);
  self.ranks_ = scratch.take<SortKey>("features.candidate_ranks", 2 * self.kept_);
  self.spare_ = scratch.take<SortKey>("features.candidate_ranks", 2 * self.kept_);
  self.places_ = scratch.take<Place>("features.candidate_places", 2 * self.kept_);
  self.chosen_ = scratch.take<Candidate>("features.chosen", std::max<size_t>(config.max_keypoints, self.kept_));
}

void CandidateList::cut() {
  rankByStrength();
  for (size_t i = 0; i < kept_; ++i) chosen_[i] = items_[ranks_[i].index];
  std::copy(chosen_.data(), chosen_.data() + kept_, items_.data());
  size_ = kept_;
}

// From the top of the image down.
void CandidateList::listPlaces() {
  for (uint32_t i = 0; i < size_; ++i) ranks_[i] = {keyOf(items_[i].y * pixelSize(items_[i])), i};
  radixSort(ranks_.data(), spare_.data(), size_);
  for (size_t i = 0; i < size_; ++i) {
    const uint32_t candidate = ranks_[i].index;
    const Candidate &c = items_[candidate];
    places_[i] = {c.x * pixelSize(c), c.y * pixelSize(c), c.strength / c.response, candidate};
  }
}

// One structure found twice: by neighbouring scales, in particular on both sides of an octave's end, or by two
// samples that refine to the same point.
bool CandidateList::isSameStructure(const Place &a, const Place &b) {
  const float smaller = std::min(a.sigma, b.sigma), larger = std::max(a.sigma, b.sigma);
  const float dx = a.x - b.x, dy = a.y - b.y;
  return larger <= kSameScale * smaller && dx * dx + dy * dy < kSamePlace * kSamePlace * smaller * smaller;
}

// A candidate with a stronger one beside it is a near-duplicate, even where that one goes too; order plays no part.
void CandidateList::markNearDuplicates() {
  listPlaces();
  for (size_t i = 0; i < size_; ++i) {
    const Place a = places_[i];
    const float reach = kSamePlace * a.sigma, left = a.x - reach, right = a.x + reach, bottom = a.y + reach;
    for (size_t j = i + 1; j < size_ && places_[j].y < bottom; ++j) {
      const Place &b = places_[j];
      if (b.x < left || b.x > right || !isSameStructure(a, b)) continue;
      Candidate &first = items_[a.candidate], &second = items_[b.candidate];
      (first.strength >= second.strength ? second : first).is_near_duplicate = true;
    }
  }
}

size_t CandidateList::rankByStrength() {
  size_t count = 0;
  for (size_t i = 0; i < size_; ++i) {
    if (!items_[i].is_near_duplicate) ranks_[count++] = {~keyOf(items_[i].strength), static_cast<uint32_t>(i)};
  }
  radixSort(ranks_.data(), spare_.data(), count);
  return count;
}

// Of the ranked, moves those that are chosen to the front; returns how many.
size_t CandidateList::chooseByCell(size_t ranked, const FeatureConfig &config, size_t limit) {
  const float share = static_cast<float>(limit) / (kCellsAcross * kCellsDown);
  const uint32_t quota = static_cast<uint32_t>(config.cell_quota * share) + 1;
  uint32_t in_cell[kCellsAcross * kCellsDown] = {};
  size_t chosen = 0, others = 0;
  for (size_t i = 0; i < ranked && chosen < limit; ++i) {
    const SortKey candidate = ranks_[i];
    if (in_cell[cellOf(items_[candidate.index], config)]++ < quota) {
      ranks_[chosen++] = candidate;
    } else {
      spare_[others++] = candidate;
    }
  }
  for (size_t i = 0; i < others && chosen < limit; ++i) ranks_[chosen++] = spare_[i];
  return chosen;
}

Span<Candidate> CandidateList::choose(const FeatureConfig &config, size_t limit) {
  markNearDuplicates();
  const size_t count = chooseByCell(rankByStrength(), config, limit);
  for (size_t i = 0; i < count; ++i) ranks_[i].key = ~keyOf(items_[ranks_[i].index].response);
  radixSort(ranks_.data(), spare_.data(), count);
  for (size_t i = 0; i < count; ++i) chosen_[i] = items_[ranks_[i].index];
  return chosen_.first(count);
}

}  // namespace sphc
