// Hints of a localizer's result, in words for people.
#pragma once
#include "host/report/bit_words.h"

namespace sphc::host {

// SPHC_HINT_ bits.
extern const std::array<BitWords, 6> kHintWords;

// "too dark, too fast"; "" of none.
std::string hintNames(uint32_t hints);

}  // namespace sphc::host
