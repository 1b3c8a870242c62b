// Why a stretch of a walk found no place in its map, in the words of the guide.
#pragma once
#include <string>
#include <vector>

#include "host/mapping/stretches.h"

namespace sphc::host {

struct StretchCause {
  std::string name, measured, cure;  // "too dark", "median grey level 6 of 255", "more light"
};

// What was measured and is not as it should be, the most urgent first; nothing where all is.
std::vector<StretchCause> causesOf(const Stretch &stretch);

// "too dark (median grey level 6 of 255): more light; ..."; what to do where nothing was measured.
std::string causesText(const std::vector<StretchCause> &causes);

}  // namespace sphc::host
