// A cloud with its truth, as the tools here hand it to each other: as point_file.h says, places being unit
// directions, then of all points a byte that is 1 for real and 0 for fake, then of all points uint32 patch.
#pragma once
#include <string>

#include "host/audit/score/known_cloud.h"

namespace sphc::host {

// Both throw std::runtime_error.
void writeCloud(const std::string &path, const KnownCloud &cloud);
KnownCloud readCloud(const std::string &path);

}  // namespace sphc::host
