#include "host/images/png_encode.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/unit/host/images/beside_opencv.h"

namespace sphc::host {
namespace {

using test::kHeight;
using test::kWidth;

// With something behind each row.
cv::Mat wideNoise(int type) {
  cv::Mat noise(kHeight, kWidth + 3, type);
  cv::theRNG().state = 7;
  cv::randu(noise, 0, type == CV_16UC1 ? 65535 : 255);
  cv::GaussianBlur(noise, noise, {}, 2);
  return noise;
}

TEST(PngEncode, OpenCvReadsWhatWasWritten) {
  for (const sphc_format format : {SPHC_FORMAT_GRAY8, SPHC_FORMAT_RGB8, SPHC_FORMAT_BGR8, SPHC_FORMAT_DEPTH16}) {
    const int type = test::matTypeOf(format);
    const cv::Mat wide = wideNoise(type), pixels = wide.colRange(0, kWidth);
    std::vector<uint8_t> png, theirs;
    ASSERT_TRUE(encodePng({pixels.data, kWidth, kHeight, static_cast<uint32_t>(pixels.step), format}, &png));
    cv::Mat read = cv::imdecode(png, cv::IMREAD_UNCHANGED);
    ASSERT_EQ(read.type(), type);
    if (format == SPHC_FORMAT_RGB8) cv::cvtColor(read, read, cv::COLOR_BGR2RGB);
    EXPECT_EQ(cv::norm(read, pixels, cv::NORM_INF), 0) << format;
    if (format == SPHC_FORMAT_DEPTH16) continue;  // compressed otherwise
    cv::imencode(".png", pixels, theirs);
    EXPECT_LT(static_cast<double>(png.size()), 1.02 * static_cast<double>(theirs.size())) << format;
  }
}

TEST(PngEncode, OtherFormatsAreNotWritten) {
  const std::vector<uint8_t> pixels(4 * kWidth * kHeight);
  std::vector<uint8_t> png;
  EXPECT_FALSE(encodePng({pixels.data(), kWidth, kHeight, 4 * kWidth, SPHC_FORMAT_BGRA8}, &png));
}

}  // namespace
}  // namespace sphc::host
