// The drivers behind openLive, one file each.
#pragma once

#include "live_source.h"
#include "spherecloud/spherecloud_capture.h"

namespace sphc::guest {

LiveSource openLibcamera(const std::string &id);
LiveSource openV4l2(const std::string &node, sphc_stream stream);

}  // namespace sphc::guest
