// Advice before release, as a map of the sky.
#pragma once
#include <opencv2/core.hpp>

#include "host/report/coverage.h"

namespace sphc::host {

// Density of the directions, holes as rings with their yaw and pitch, and where the cameras of failed frames looked
// as crosses.
cv::Mat drawCoverage(const std::vector<std::array<double, 3>> &directions, const std::vector<Hole> &holes,
                     const std::vector<std::array<double, 3>> &failed_views);

}  // namespace sphc::host
