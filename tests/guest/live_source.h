// A driver by a word: "v4l2:/dev/video0", or "libcamera:" for the first camera that libcamera sees.
#pragma once

#include <spherecloud/spherecloud_capture.h>

#include <memory>
#include <string>

namespace sphc::guest {

struct LiveSource {
  sphc_source source;
  std::shared_ptr<void> handle;  // closes the driver
};

// Throws std::runtime_error with the driver's message.
LiveSource openLive(const std::string &what, sphc_stream stream);

}  // namespace sphc::guest
