// What is wrong with the clocks of a recording, with the cure.
#pragma once
#include <string>
#include <vector>

#include "host/mapping/walk_times.h"

namespace sphc::host {

// Sentences for a person; none where all is well.
std::vector<std::string> complaintsOf(const WalkTimes &times);

}  // namespace sphc::host
