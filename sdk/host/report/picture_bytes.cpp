#include "host/report/picture_bytes.h"

#include <spherecloud/spherecloud.h>

#include <stdexcept>

#include "host/images/jpeg.h"
#include "host/images/png_encode.h"

namespace sphc::host {
namespace {

sphc_image imageOf(const cv::Mat &picture) {
  if (picture.empty() || (picture.type() != CV_8UC1 && picture.type() != CV_8UC3))
    throw std::runtime_error("a picture has no pixels that a file can have; please report it");
  return {picture.data, static_cast<uint32_t>(picture.cols), static_cast<uint32_t>(picture.rows),
          static_cast<uint32_t>(picture.step), picture.channels() == 1 ? SPHC_FORMAT_GRAY8 : SPHC_FORMAT_BGR8};
}

[[noreturn]] void failEncoding() {
  throw std::runtime_error("a picture cannot be encoded: memory ran out; free some");
}

}  // namespace

std::vector<uint8_t> pngOf(const cv::Mat &picture) {
  std::vector<uint8_t> png;
  if (!encodePng(imageOf(picture), &png)) failEncoding();
  return png;
}

std::vector<uint8_t> jpegOf(const cv::Mat &picture, uint32_t quality) {
  std::vector<uint8_t> jpeg;
  if (!encodeJpeg(imageOf(picture), quality, &jpeg)) failEncoding();
  return jpeg;
}

}  // namespace sphc::host
