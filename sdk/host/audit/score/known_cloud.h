// A cloud as published, and which of its points are real.
#pragma once
#include <vector>

#include "host/audit/attack/published.h"
#include "host/publish/fakes/strategy.h"

namespace sphc::host {

struct KnownCloud {
  Published published;  // directions and descriptors alone
  std::vector<bool> real;
  std::vector<uint32_t> patches;  // with which each point came
};

KnownCloud knownCloud(const std::vector<Assignment> &assignments);

}  // namespace sphc::host
