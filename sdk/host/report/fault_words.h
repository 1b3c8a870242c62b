// Faults that a localizer's result names, in words for people.
#pragma once
#include <array>
#include <cstdint>
#include <string>

namespace sphc::host {

struct FaultWords {
  uint32_t fault;  // SPHC_FAULT_ bit
  const char *name, *cure;
};
extern const std::array<FaultWords, 9> kFaultWords;

// "depth frozen, depth and colour disagree"; "" of none.
std::string faultNames(uint32_t faults);

}  // namespace sphc::host
