// The reliability diagram: share that is right against confidence.
#pragma once
#include <string>
#include <vector>

#include "host/report/plots.h"
#include "host/report/reliability.h"

namespace sphc::host {

struct ReliabilitySeries {
  std::string name;
  std::vector<Graded> graded;
};

// A line a series over bins of equal width, 95 % bars; below, how many answers each bin holds.
std::string reliabilityScript(const std::vector<ReliabilitySeries> &series);
// Of a run; an empty script when no frame has both a confidence and a truth.
Drawing reliability(const Run &run);

}  // namespace sphc::host
