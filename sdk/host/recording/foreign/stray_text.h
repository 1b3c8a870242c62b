// The text files of a StrayScanner recording (https://docs.strayrobots.io/apps/scanner/format.html).
#pragma once

#include <spherecloud/spherecloud.h>

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace sphc::recording {

using PinholeParams = std::array<double, 4>;  // fx, fy, cx, cy in pixels of the colour image

struct StrayFrame {
  int64_t time_ns;
  uint32_t number;
  std::optional<sphc_rigid> world_from_camera;  // none where the line holds no pose; camera axes are ours
};

struct StrayOdometry {
  std::vector<StrayFrame> frames;       // times and numbers increase
  std::optional<PinholeParams> params;  // the median over the frames; files of older versions have none
};

// odometry.csv: one line of names, then a line a frame.  Throws Failure (ARGUMENT); its text begins with the line.
StrayOdometry strayOdometryFrom(std::string_view text);

// camera_matrix.csv: three lines of three numbers.  Throws Failure (ARGUMENT).
PinholeParams strayCameraFrom(std::string_view text);

}  // namespace sphc::recording
