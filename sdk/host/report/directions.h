// Little mathematics without Eigen, which would take longer to compile here than everything else of the report.
#pragma once
#include <array>
#include <cmath>

namespace sphc::host {

constexpr double kDegree = M_PI / 180;

inline double dotProduct(const std::array<double, 3> &a, const std::array<double, 3> &b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace sphc::host
