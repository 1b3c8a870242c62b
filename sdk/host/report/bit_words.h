// Bits of a localizer's result, in words for people.
#pragma once
#include <array>
#include <cstdint>
#include <string>

namespace sphc::host {

struct BitWords {
  uint32_t bit;
  const char *name, *cure;
};

// Of the bits that are set, "depth frozen, depth constant"; "" of none.
template <size_t N>
std::string namesOf(const std::array<BitWords, N> &words, uint32_t bits) {
  std::string names;
  for (const BitWords &word : words)
    if (bits & word.bit) names += (names.empty() ? "" : ", ") + std::string(word.name);
  return names;
}

// Adds one to the count of each bit that is set.
template <size_t N>
void countBits(const std::array<BitWords, N> &words, uint32_t bits, std::array<uint32_t, N> *counts) {
  for (size_t i = 0; i < N; ++i) (*counts)[i] += (bits & words[i].bit) != 0;
}

}  // namespace sphc::host
