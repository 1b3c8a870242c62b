// The path seen from above, whatever the axes of the recording's world are.
#pragma once
#include <array>
#include <vector>

#include "host/report/run.h"

namespace sphc::host {

// Two horizontal unit vectors of the base, as seen from above: axes of the base where an axis is up; else the
// path's longest extent runs to the right.
struct TopView {
  std::array<double, 3> right = {1, 0, 0}, up = {0, 1, 0};  // `up` of the picture
  bool is_up_an_axis = true;                                // of the base; else as the cameras were held on average
  std::array<double, 2> project(const double point_m[3]) const;
};

// "Above" is against the mean of the cameras' down axes: people hold cameras upright more often than not.
TopView topView(const std::vector<sphc_rigid> &base_from_camera);

}  // namespace sphc::host
