// Which places of a walk look like a frame?  By the rare words that both have (Sivic and Zisserman 2003), while the
// walk still grows.
#pragma once
#include <functional>
#include <vector>

#include "host/mapping/walk_frame.h"

namespace sphc::host {

class PlaceWords {
 public:
  // `frames`: of all places, of which the last is new.  Words are some of their descriptors, drawn anew as the walk
  // becomes four times as long.
  void add(const std::vector<WalkFrame> &frames);
  // Forgets the last place.
  void removeLast();
  // Of the places that may be meant: the most alike, best first, none beside another.  None before there are words.
  std::vector<uint32_t> likely(const WalkFrame &frame, const std::function<bool(uint32_t)> &may_be,
                               size_t most) const;

 private:
  struct WordCount {
    uint32_t word, count;
  };
  using Words = std::vector<WordCount>;  // in order of the words

  void draw(const std::vector<WalkFrame> &frames);
  Words wordsOf(const WalkFrame &frame) const;
  std::vector<double> rarity() const;

  std::vector<Descriptor> vocabulary_;
  std::vector<Words> places_;
};

}  // namespace sphc::host
