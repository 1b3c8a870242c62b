// The line that live shows.
#pragma once
#include <spherecloud/spherecloud.h>

#include <string>
#include <vector>

namespace sphc::host {

struct LiveNumbers {
  double color_hz = 0, depth_hz = 0, poses_hz = 0;
  uint64_t lost = 0;  // images
  double ms = 0;      // that the frame took
};

// `maps`: the files, in the order of their ids.  Of several maps the one of the pose is named; faults or hints
// stand where there is no pose.
std::string livePoseText(const sphc_localizer_result &result, const std::vector<std::string> &maps);
// Of one map, all but the last numbers are within 79 columns.
std::string liveLine(const sphc_localizer_result &result, const std::vector<std::string> &maps,
                     const LiveNumbers &numbers);

}  // namespace sphc::host
