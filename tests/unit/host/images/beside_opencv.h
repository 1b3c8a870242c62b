// Image files, as they are read here and as OpenCV reads them.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "host/images/decoded.h"

namespace sphc::test {

using FileBytes = std::vector<uint8_t>;

constexpr uint32_t kWidth = 83, kHeight = 61;

inline int matTypeOf(sphc_format format) {
  if (format == SPHC_FORMAT_DEPTH16) return CV_16UC1;
  if (format == SPHC_FORMAT_BGRA8) return CV_8UC4;
  return format == SPHC_FORMAT_GRAY8 ? CV_8UC1 : CV_8UC3;
}

struct ReadImage {
  host::Decoded decoded;
  cv::Mat pixels;
};

// By decodePng or decodeJpeg.
template <typename Decode>
ReadImage readBy(Decode &&decode, const FileBytes &file, sphc_format format, uint32_t width = kWidth,
                 uint32_t height = kHeight) {
  cv::Mat pixels = cv::Mat::zeros(static_cast<int>(height), static_cast<int>(width), matTypeOf(format));
  const host::Decoded decoded = decode(file.data(), file.size(), {pixels.data, width, height, format});
  return {decoded, pixels};
}

// Not RGB8.  Nothing where OpenCV refuses, or has something of another type.
inline cv::Mat readByOpenCv(const FileBytes &file, sphc_format format) {
  if (file.empty()) return {};
  int flags = cv::IMREAD_UNCHANGED;
  if (format == SPHC_FORMAT_GRAY8) flags = cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION;
  if (format == SPHC_FORMAT_BGR8) flags = cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION;
  const cv::Mat pixels = cv::imdecode(file, flags);
  return pixels.type() == matTypeOf(format) ? pixels : cv::Mat();
}

inline bool areSame(const cv::Mat &a, const cv::Mat &b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

}  // namespace sphc::test
