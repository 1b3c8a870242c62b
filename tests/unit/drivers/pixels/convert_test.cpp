#include "drivers/pixels/convert.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

namespace sphc::pixels {
namespace {

constexpr uint32_t kWidth = 34, kHeight = 18;

std::vector<uint8_t> randomBytes(size_t count) {
  std::mt19937 engine(7);
  std::vector<uint8_t> bytes(count);
  for (uint8_t &byte : bytes) byte = static_cast<uint8_t>(engine());
  return bytes;
}

// The output tightly packed, at a stride of its own in the call to see that the padding stays as it was.
std::vector<uint8_t> converted(const RawImage &raw, sphc_format format) {
  constexpr uint32_t kPadding = 10;
  const uint32_t row_bytes = sphc_format_bytes(format) * raw.width, stride = row_bytes + kPadding;
  std::vector<uint8_t> padded(stride * raw.height, 0xa5);
  const OutImage out{padded.data(), padded.size(), raw.width, raw.height, stride, format};
  sphc_message message{};
  EXPECT_EQ(convert(raw, out, &message), SPHC_OK) << message.text;
  std::vector<uint8_t> packed;
  for (uint32_t y = 0; y < raw.height; ++y) {
    const auto row = padded.begin() + y * stride;
    packed.insert(packed.end(), row, row + row_bytes);
    for (uint32_t i = row_bytes; i < stride; ++i) EXPECT_EQ(row[i], 0xa5) << "padding of row " << y;
  }
  return packed;
}

std::vector<uint8_t> byOpenCv(const cv::Mat &raw, int code) {
  cv::Mat out;
  cv::cvtColor(raw, out, code);
  return {out.datastart, out.dataend};
}

void expectNear(const std::vector<uint8_t> &ours, const std::vector<uint8_t> &theirs, int tolerance) {
  ASSERT_EQ(ours.size(), theirs.size());
  for (size_t i = 0; i < ours.size(); ++i) ASSERT_NEAR(ours[i], theirs[i], tolerance) << "byte " << i;
}

RawImage tight(Layout layout, std::vector<uint8_t> &bytes, YuvRange range = YuvRange::Limited) {
  return contiguous(layout, range, kWidth, kHeight, rowBytes(layout, kWidth), bytes.data(), bytes.size());
}

struct YuvCase {
  Layout layout;
  int rows, channels;  // as OpenCV wants them
  int to_rgb, to_bgr, to_gray;
};
const YuvCase kYuvCases[] = {
    {Layout::Yuyv, kHeight, 2, cv::COLOR_YUV2RGB_YUYV, cv::COLOR_YUV2BGR_YUYV, cv::COLOR_YUV2GRAY_YUYV},
    {Layout::Uyvy, kHeight, 2, cv::COLOR_YUV2RGB_UYVY, cv::COLOR_YUV2BGR_UYVY, cv::COLOR_YUV2GRAY_UYVY},
    {Layout::Nv12, kHeight * 3 / 2, 1, cv::COLOR_YUV2RGB_NV12, cv::COLOR_YUV2BGR_NV12, cv::COLOR_YUV2GRAY_NV12}};

TEST(Convert, AgreesWithOpenCvOnYuvOfLimitedRange) {
  for (const YuvCase &yuv : kYuvCases) {
    std::vector<uint8_t> bytes = randomBytes(size_t{kWidth} * yuv.rows * yuv.channels);
    const cv::Mat mat(yuv.rows, kWidth, CV_8UC(yuv.channels), bytes.data());
    const RawImage raw = tight(yuv.layout, bytes);
    // OpenCV's coefficients have three digits, and it lets no luma fall below black before it adds the colour.
    for (uint8_t &byte : bytes) byte = static_cast<uint8_t>(16 + byte * 219 / 255);
    expectNear(converted(raw, SPHC_FORMAT_RGB8), byOpenCv(mat, yuv.to_rgb), 1);
    expectNear(converted(raw, SPHC_FORMAT_BGR8), byOpenCv(mat, yuv.to_bgr), 1);
    EXPECT_EQ(converted(raw, SPHC_FORMAT_GRAY8), byOpenCv(mat, yuv.to_gray));
  }
}

TEST(Convert, FollowsTheDefinitionOfFullRange) {
  std::vector<uint8_t> bytes = randomBytes(2 * kWidth * kHeight);
  const std::vector<uint8_t> rgb = converted(tight(Layout::Yuyv, bytes, YuvRange::Full), SPHC_FORMAT_RGB8);
  for (size_t i = 0; i < kWidth * kHeight; ++i) {
    const double y = bytes[2 * i], u = bytes[i / 2 * 4 + 1] - 128.0, v = bytes[i / 2 * 4 + 3] - 128.0;
    const double expected[] = {y + 1.402 * v, y - 0.344136 * u - 0.714136 * v, y + 1.772 * u};
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(rgb[3 * i + c], std::fmin(std::fmax(expected[c], 0), 255), 0.51);
  }
}

TEST(Convert, MapsBlackAndWhiteOfBothRanges) {
  const auto white = [](uint8_t luma, YuvRange range) {
    std::vector<uint8_t> bytes(2 * kWidth * kHeight, 128);
    for (size_t i = 0; i < bytes.size(); i += 2) bytes[i] = luma;
    return converted(tight(Layout::Yuyv, bytes, range), SPHC_FORMAT_RGB8)[0];
  };
  EXPECT_EQ(white(16, YuvRange::Limited), 0);
  EXPECT_EQ(white(235, YuvRange::Limited), 255);
  EXPECT_EQ(white(255, YuvRange::Limited), 255);
  EXPECT_EQ(white(0, YuvRange::Full), 0);
  EXPECT_EQ(white(255, YuvRange::Full), 255);
}

TEST(Convert, OrdersColours) {
  std::vector<uint8_t> bytes = randomBytes(3 * kWidth * kHeight);
  const cv::Mat mat(kHeight, kWidth, CV_8UC3, bytes.data());
  const std::vector<uint8_t> swapped = byOpenCv(mat, cv::COLOR_RGB2BGR);
  EXPECT_EQ(converted(tight(Layout::Rgb24, bytes), SPHC_FORMAT_RGB8), bytes);
  EXPECT_EQ(converted(tight(Layout::Rgb24, bytes), SPHC_FORMAT_BGR8), swapped);
  EXPECT_EQ(converted(tight(Layout::Bgr24, bytes), SPHC_FORMAT_BGR8), bytes);
  EXPECT_EQ(converted(tight(Layout::Bgr24, bytes), SPHC_FORMAT_RGB8), swapped);
  expectNear(converted(tight(Layout::Rgb24, bytes), SPHC_FORMAT_GRAY8), byOpenCv(mat, cv::COLOR_RGB2GRAY), 1);
  expectNear(converted(tight(Layout::Bgr24, bytes), SPHC_FORMAT_GRAY8), byOpenCv(mat, cv::COLOR_BGR2GRAY), 1);
}

TEST(Convert, LeavesOutTheFourthByte) {
  std::vector<uint8_t> bytes = randomBytes(4 * kWidth * kHeight);
  const cv::Mat mat(kHeight, kWidth, CV_8UC4, bytes.data());
  EXPECT_EQ(converted(tight(Layout::Bgrx32, bytes), SPHC_FORMAT_BGR8), byOpenCv(mat, cv::COLOR_BGRA2BGR));
  EXPECT_EQ(converted(tight(Layout::Bgrx32, bytes), SPHC_FORMAT_RGB8), byOpenCv(mat, cv::COLOR_BGRA2RGB));
  expectNear(converted(tight(Layout::Bgrx32, bytes), SPHC_FORMAT_GRAY8), byOpenCv(mat, cv::COLOR_BGRA2GRAY), 1);
}

TEST(Convert, CopiesGrey) {
  std::vector<uint8_t> bytes = randomBytes(kWidth * kHeight);
  const cv::Mat mat(kHeight, kWidth, CV_8UC1, bytes.data());
  EXPECT_EQ(converted(tight(Layout::Grey, bytes), SPHC_FORMAT_GRAY8), bytes);
  EXPECT_EQ(converted(tight(Layout::Grey, bytes), SPHC_FORMAT_RGB8), byOpenCv(mat, cv::COLOR_GRAY2RGB));
  EXPECT_EQ(converted(tight(Layout::Grey, bytes), SPHC_FORMAT_BGR8), byOpenCv(mat, cv::COLOR_GRAY2RGB));
}

TEST(Convert, ReadsDepthLowerByteFirst) {
  std::vector<uint8_t> bytes = randomBytes(2 * kWidth * kHeight);
  const std::vector<uint8_t> depth = converted(tight(Layout::Depth16, bytes), SPHC_FORMAT_DEPTH16);
  for (size_t i = 0; i < kWidth * kHeight; ++i) {
    uint16_t units;
    std::memcpy(&units, depth.data() + 2 * i, sizeof units);
    ASSERT_EQ(units, bytes[2 * i] + 256 * bytes[2 * i + 1]);
  }
}

TEST(Convert, SkipsTheCamerasPadding) {
  constexpr uint32_t kStride = 2 * kWidth + 6;
  std::vector<uint8_t> padded = randomBytes(kStride * kHeight), packed;
  for (uint32_t y = 0; y < kHeight; ++y)
    packed.insert(packed.end(), padded.begin() + y * kStride, padded.begin() + y * kStride + 2 * kWidth);
  for (const Layout layout : {Layout::Yuyv, Layout::Depth16}) {
    const sphc_format format = layout == Layout::Yuyv ? SPHC_FORMAT_BGR8 : SPHC_FORMAT_DEPTH16;
    const RawImage raw = contiguous(layout, YuvRange::Limited, kWidth, kHeight, kStride, padded.data(),
                                    padded.size() - 6);  // the last row ends with its pixels
    EXPECT_EQ(converted(raw, format), converted(tight(layout, packed), format));
  }
}

TEST(Convert, TakesChromaFromAnotherBuffer) {
  std::vector<uint8_t> bytes = randomBytes(kWidth * kHeight * 3 / 2);
  constexpr uint32_t kStride = kWidth + 30;
  std::vector<uint8_t> chroma(kStride * kHeight / 2);
  for (uint32_t y = 0; y < kHeight / 2; ++y)
    std::memcpy(chroma.data() + y * kStride, bytes.data() + kWidth * (kHeight + y), kWidth);
  const RawImage one = tight(Layout::Nv12, bytes);
  RawImage two = one;
  two.planes[1] = {chroma.data(), chroma.size(), kStride};
  EXPECT_EQ(converted(two, SPHC_FORMAT_RGB8), converted(one, SPHC_FORMAT_RGB8));
}

TEST(Convert, RefusesDepthAsColourAndColourAsDepth) {
  std::vector<uint8_t> bytes(4 * kWidth * kHeight), pixels(4 * kWidth * kHeight);
  const auto tried = [&](Layout layout, sphc_format format) {
    const OutImage out{pixels.data(), pixels.size(), kWidth, kHeight, sphc_format_bytes(format) * kWidth, format};
    sphc_message message{};
    const sphc_status status = convert(tight(layout, bytes), out, &message);
    EXPECT_EQ(status == SPHC_OK, canConvert(layout, format));
    EXPECT_EQ(status == SPHC_OK, message.text[0] == '\0');
    return status;
  };
  EXPECT_EQ(tried(Layout::Depth16, SPHC_FORMAT_GRAY8), SPHC_E_UNSUPPORTED);
  EXPECT_EQ(tried(Layout::Depth16, SPHC_FORMAT_RGB8), SPHC_E_UNSUPPORTED);
  for (const Layout layout :
       {Layout::Grey, Layout::Yuyv, Layout::Uyvy, Layout::Nv12, Layout::Rgb24, Layout::Bgr24, Layout::Bgrx32})
    EXPECT_EQ(tried(layout, SPHC_FORMAT_DEPTH16), SPHC_E_UNSUPPORTED);
  EXPECT_EQ(tried(Layout::Bgrx32, SPHC_FORMAT_BGRA8), SPHC_E_IMAGE);  // drivers do not deliver it
  EXPECT_EQ(tried(Layout::Nv12, SPHC_FORMAT_NV12), SPHC_E_IMAGE);
}

TEST(Convert, RefusesAnotherSize) {
  std::vector<uint8_t> bytes(kWidth * kHeight), pixels(kWidth * kHeight, 9);
  const OutImage out{pixels.data(), pixels.size(), kWidth, kHeight - 1, kWidth, SPHC_FORMAT_GRAY8};
  sphc_message message{};
  EXPECT_EQ(convert(tight(Layout::Grey, bytes), out, &message), SPHC_E_IMAGE);
  EXPECT_STREQ(message.text, "the camera's image is 34 x 18 pixels, the output 34 x 17; must be equal");
  EXPECT_EQ(pixels, std::vector<uint8_t>(kWidth * kHeight, 9));
}

}  // namespace
}  // namespace sphc::pixels
