// Hints of a localizer's result, in words for people.
#pragma once
#include <array>
#include <cstdint>
#include <string>

namespace sphc::host {

struct HintWords {
  uint32_t hint;  // SPHC_HINT_ bit
  const char *name, *cure;
};
extern const std::array<HintWords, 6> kHintWords;

// "too dark, too fast"; "" of none.
std::string hintNames(uint32_t hints);
// Of the first alone, for one line: "too dark: more light"; "" of none.
std::string firstHint(uint32_t hints);

}  // namespace sphc::host
