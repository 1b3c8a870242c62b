// Where a map's directions point, as a world map of the sphere.
#pragma once
#include <array>
#include <opencv2/core.hpp>
#include <vector>

namespace sphc::host {

enum class Longitudes { kNumbered, kBare };  // bare: of directions that were turned first

// Density of unit directions, equirectangular: longitude (around z, x in the middle) to the left, z up. Brightness
// is the density over that of evenly spread directions; `*peak` receives the brightest.
cv::Mat drawDirections(const std::vector<std::array<double, 3>> &directions, double *peak,
                       Longitudes longitudes = Longitudes::kNumbered);

}  // namespace sphc::host
