// Faults that a localizer's result names, in words for people.
#pragma once
#include "host/report/bit_words.h"

namespace sphc::host {

// SPHC_FAULT_ bits.
extern const std::array<BitWords, 13> kFaultWords;

// "depth frozen, depth and colour disagree"; "" of none.
std::string faultNames(uint32_t faults);

}  // namespace sphc::host
