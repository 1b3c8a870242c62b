// Images beside a COLMAP model: PNG or JPEG, by their first bytes, and of their camera's size.
#pragma once

#include <spherecloud/spherecloud.h>

#include <opencv2/core.hpp>
#include <string>

namespace sphc::host {

// As COLMAP saw it, however a viewer is told to turn it; in grey.  Throws std::runtime_error with cause and cure,
// as does the other.
cv::Mat readColmapPhoto(const std::string &path, const sphc_camera &camera);

// A PNG image of 16 bits.
cv::Mat readColmapDepth(const std::string &path, const sphc_camera &camera);

}  // namespace sphc::host
