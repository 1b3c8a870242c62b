// A picture in a file of its own.
#pragma once
#include <opencv2/core.hpp>
#include <string>

namespace sphc::host {

// In the format that the name's ending says.  Throws std::runtime_error with cause and cure.
void writePicture(const std::string &path, const cv::Mat &picture);

}  // namespace sphc::host
