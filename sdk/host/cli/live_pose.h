// The pose of a frame in the line that live shows.
#pragma once
#include <spherecloud/spherecloud.h>

#include <string>
#include <vector>

namespace sphc::host {

// `maps`: the files, in the order of their ids.  Of several maps the one of the pose is named; a fault or a hint
// stands where there is no pose.
std::string livePoseText(const sphc_localizer_result &result, const std::vector<std::string> &maps);

}  // namespace sphc::host
