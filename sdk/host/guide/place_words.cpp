#include "host/guide/place_words.h"

#include <algorithm>
#include <cmath>

#include "runtime/stages/match/distance.h"

namespace sphc::host {
namespace {

constexpr size_t kFirstDrawn = 8, kLastDrawn = 512;  // places; in between at each fourfold
constexpr size_t kVocabulary = 1024;
constexpr uint32_t kBeside = 4;  // places

struct Likeness {
  double score;
  uint32_t place;
};

bool isBeside(uint32_t a, uint32_t b) { return std::max(a, b) - std::min(a, b) < kBeside; }

}  // namespace

void PlaceWords::add(const std::vector<WalkFrame> &frames) {
  places_.push_back(wordsOf(frames.back()));
  for (size_t places = kFirstDrawn; places <= kLastDrawn; places *= 4)
    if (frames.size() == places) draw(frames);
}

void PlaceWords::removeLast() { places_.pop_back(); }

// Some descriptors of all places, evenly.
void PlaceWords::draw(const std::vector<WalkFrame> &frames) {
  size_t all = 0;
  for (const WalkFrame &frame : frames) all += frame.descriptors.size();
  const size_t step = std::max<size_t>(1, all / kVocabulary);
  vocabulary_.clear();
  size_t at = 0;
  for (const WalkFrame &frame : frames)
    for (const Descriptor &descriptor : frame.descriptors)
      if (at++ % step == 0) vocabulary_.push_back(descriptor);
  for (size_t place = 0; place < frames.size(); ++place) places_[place] = wordsOf(frames[place]);
}

PlaceWords::Words PlaceWords::wordsOf(const WalkFrame &frame) const {
  if (vocabulary_.empty()) return {};
  std::vector<uint32_t> all(frame.descriptors.size());
  for (uint32_t i = 0; i < all.size(); ++i) all[i] = i;
  std::vector<NearestTwo> nearest(all.size(), {UINT32_MAX, UINT32_MAX, 0});
  searchRange({vocabulary_.data(), vocabulary_.size()}, 0, static_cast<uint32_t>(vocabulary_.size()),
              {frame.descriptors.data(), frame.descriptors.size()}, {all.data(), all.size()},
              {nearest.data(), nearest.size()});
  std::sort(nearest.begin(), nearest.end(),
            [](const NearestTwo &a, const NearestTwo &b) { return a.best_index < b.best_index; });
  Words words;
  for (const NearestTwo &n : nearest) {
    if (words.empty() || words.back().word != n.best_index) words.push_back({n.best_index, 0});
    ++words.back().count;
  }
  return words;
}

std::vector<double> PlaceWords::rarity() const {
  std::vector<double> with(vocabulary_.size());
  for (const Words &words : places_)
    for (const WordCount &w : words) ++with[w.word];
  for (double &w : with) w = std::log(static_cast<double>(places_.size() + 1) / (w + 1));
  return with;
}

std::vector<uint32_t> PlaceWords::likely(const WalkFrame &frame, const std::function<bool(uint32_t)> &may_be,
                                         size_t most) const {
  const std::vector<double> rare = rarity();
  std::vector<double> wanted(vocabulary_.size());
  for (const WordCount &w : wordsOf(frame)) wanted[w.word] = w.count * rare[w.word];
  std::vector<Likeness> alike;
  for (uint32_t place = 0; place < places_.size(); ++place) {
    if (!may_be(place)) continue;
    double product = 0, length2 = 0;
    for (const WordCount &w : places_[place]) {
      const double weight = w.count * rare[w.word];
      product += weight * wanted[w.word];
      length2 += weight * weight;
    }
    if (product > 0) alike.push_back({product / std::sqrt(length2), place});
  }
  std::stable_sort(alike.begin(), alike.end(),
                   [](const Likeness &a, const Likeness &b) { return a.score > b.score; });
  std::vector<uint32_t> taken;
  for (const Likeness &one : alike) {
    if (taken.size() == most) break;
    const bool is_beside =
        std::any_of(taken.begin(), taken.end(), [&](uint32_t other) { return isBeside(one.place, other); });
    if (!is_beside) taken.push_back(one.place);
  }
  return taken;
}

}  // namespace sphc::host
