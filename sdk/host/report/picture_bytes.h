// A picture as the bytes of a file.
#pragma once
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace sphc::host {

// Of grey, or of blue, green and red, in bytes.  Both throw std::runtime_error.
std::vector<uint8_t> pngOf(const cv::Mat &picture);
std::vector<uint8_t> jpegOf(const cv::Mat &picture, uint32_t quality);

}  // namespace sphc::host
