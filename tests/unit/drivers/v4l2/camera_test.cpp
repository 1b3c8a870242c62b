// Good days: what comes out is what the device put in.
#include <gmock/gmock.h>

#include <cstring>
#include <numeric>

#include "drivers/pixels/convert.h"
#include "opened_camera.h"
#include "tests/support/jpeg_frame.h"

namespace sphc::v4l2 {
namespace {

std::vector<uint8_t> bytesOf(const sphc_image &image) {
  const uint32_t row_bytes = sphc_format_bytes(image.format) * image.width;
  std::vector<uint8_t> bytes;
  for (uint32_t y = 0; y < image.height; ++y) {
    const uint8_t *row = static_cast<const uint8_t *>(image.data) + size_t{y} * image.stride_bytes;
    bytes.insert(bytes.end(), row, row + row_bytes);
  }
  return bytes;
}

// What the device sent as frame `number`, as the C interface should have it.
std::vector<uint8_t> expected(pixels::Layout layout, uint32_t padding, uint32_t number, sphc_format format) {
  const uint32_t stride = pixels::rowBytes(layout, kWidth) + padding;
  std::vector<uint8_t> raw(stride * kHeight * (layout == pixels::Layout::Nv12 ? 3 : 2) / 2);
  test::paintPattern(number, raw.data(), static_cast<uint32_t>(raw.size()));
  std::vector<uint8_t> out(sphc_format_bytes(format) * kWidth * kHeight);
  const pixels::OutImage image{out.data(), out.size(), kWidth, kHeight, sphc_format_bytes(format) * kWidth, format};
  sphc_message message = {};
  EXPECT_EQ(pixels::convert(pixels::contiguous(layout, pixels::YuvRange::Limited, kWidth, kHeight, stride,
                                               raw.data(), raw.size()),
                            image, &message),
            SPHC_OK)
      << message.text;
  return out;
}

struct LayoutCase {
  uint32_t fourcc;
  pixels::Layout layout;
};
const LayoutCase kColorLayouts[] = {
    {V4L2_PIX_FMT_GREY, pixels::Layout::Grey},    {V4L2_PIX_FMT_NV12, pixels::Layout::Nv12},
    {V4L2_PIX_FMT_YUYV, pixels::Layout::Yuyv},    {V4L2_PIX_FMT_UYVY, pixels::Layout::Uyvy},
    {V4L2_PIX_FMT_RGB24, pixels::Layout::Rgb24},  {V4L2_PIX_FMT_BGR24, pixels::Layout::Bgr24},
    {V4L2_PIX_FMT_XBGR32, pixels::Layout::Bgrx32}};

void expectFrames(uint32_t fourcc, pixels::Layout layout, uint32_t padding, const sphc_v4l2_config &config) {
  test::FakeCamera fake({{fourcc, kWidth, kHeight, 30}});
  fake.row_padding = padding;
  RunningCamera running(std::move(fake), config);
  for (uint32_t number = 0; number < 8; ++number) {
    const sphc_capture capture = running.opened.take();
    EXPECT_EQ(capture.sequence, number);
    EXPECT_EQ(capture.stream, config.stream);
    EXPECT_EQ(bytesOf(capture.image), expected(layout, padding, number, capture.image.format))
        << "frame " << number;
    running.opened.release(capture);
  }
}

TEST(Camera, GivesEveryColourLayoutInEveryFormat) {
  for (const LayoutCase &color : kColorLayouts)
    for (const sphc_format format : {SPHC_FORMAT_GRAY8, SPHC_FORMAT_RGB8, SPHC_FORMAT_BGR8})
      for (const uint32_t padding : {0u, 32u}) {
        sphc_v4l2_config config = configFor(SPHC_STREAM_COLOR);
        config.format = format;
        expectFrames(color.fourcc, color.layout, padding, config);
      }
}

TEST(Camera, GivesDepthLentCopiedAndByDmabuf) {
  for (const uint32_t fourcc : {uint32_t{V4L2_PIX_FMT_Z16}, uint32_t{V4L2_PIX_FMT_Y16}})
    for (const uint32_t padding : {0u, 6u, 7u})  // an odd stride cannot be lent
      for (const uint32_t way : {0u, 1u, 2u}) {
        sphc_v4l2_config config = configFor(SPHC_STREAM_DEPTH);
        config.always_copy = way == 1;
        config.export_dmabuf = way == 2;
        expectFrames(fourcc, pixels::Layout::Depth16, padding, config);
      }
}

TEST(Camera, GivesMjpegAtItsOwnLength) {
  const std::vector<uint8_t> jpeg = test::jpegFrame(test::gradientRgb(kWidth, kHeight), kWidth, kHeight);
  test::FakeCamera fake({{V4L2_PIX_FMT_MJPEG, kWidth, kHeight, 30}});
  fake.paint = [&](test::FakeFrame &frame) {
    std::copy(jpeg.begin(), jpeg.end(), frame.data);
    frame.bytes_used = static_cast<uint32_t>(jpeg.size());
  };
  sphc_v4l2_config config = configFor(SPHC_STREAM_COLOR);
  config.format = SPHC_FORMAT_RGB8;
  RunningCamera running(std::move(fake), config);
  const std::vector<uint8_t> pixels = bytesOf(running.opened.take().image),
                             rgb = test::gradientRgb(kWidth, kHeight);
  for (size_t i = 0; i < rgb.size(); ++i) ASSERT_NEAR(pixels[i], rgb[i], 8);
}

TEST(Camera, SaysTheTimesOfEachFrame) {
  RunningCamera running(depthCamera(), configFor(SPHC_STREAM_DEPTH));
  const int64_t first_ns = running.opened.take().time_ns;
  for (int i = 1; i < 3; ++i) {
    const sphc_capture capture = running.opened.take();
    EXPECT_NEAR(static_cast<double>(capture.time_ns - first_ns), static_cast<double>(i * kPeriodNs), 1000)
        << "of microseconds";
    EXPECT_EQ(capture.time_point, SPHC_TIME_START);
    EXPECT_EQ(capture.clock, SPHC_CLOCK_MONOTONIC);
    EXPECT_GE(capture.arrival_ns, capture.time_ns);
    EXPECT_LT(capture.arrival_ns, capture.time_ns + 1000000);
    EXPECT_EQ(capture.exposure_us, 0u);
    EXPECT_GT(capture.time_sigma_us, 0u);
  }
}

TEST(Camera, LendsDepthInTheKernelsBuffers) {
  RunningCamera running(depthCamera(), configFor(SPHC_STREAM_DEPTH));
  EXPECT_EQ(running.opened.mode().zero_copy, 1u);
  const sphc_capture kept = running.opened.take();
  const std::vector<uint8_t> before = bytesOf(kept.image);
  for (int i = 0; i < 20; ++i) running.opened.release(running.opened.take());
  EXPECT_EQ(bytesOf(kept.image), before) << "not overwritten while on loan";
  EXPECT_EQ(running.opened.stats().lost, 0u);
  EXPECT_EQ(running.opened.stats().starved, 0u);
}

TEST(Camera, GivesTheDmabufOfALoanAlone) {
  sphc_v4l2_config config = configFor(SPHC_STREAM_DEPTH);
  config.export_dmabuf = 1;
  RunningCamera running(depthCamera(), config);
  const sphc_capture first = running.opened.take(), second = running.opened.take();
  int32_t first_fd = -1, second_fd = -1;
  EXPECT_EQ(sphc_v4l2_dmabuf(running.opened.handle, &first, &first_fd), SPHC_OK);
  EXPECT_EQ(sphc_v4l2_dmabuf(running.opened.handle, &second, &second_fd), SPHC_OK);
  EXPECT_GE(first_fd, 0);
  EXPECT_NE(first_fd, second_fd);
  running.opened.release(first);
  EXPECT_EQ(sphc_v4l2_dmabuf(running.opened.handle, &first, &first_fd), SPHC_E_ARGUMENT);
  config.always_copy = 1;
  RunningCamera copying(depthCamera(), config);
  const sphc_capture copied = copying.opened.take();
  EXPECT_EQ(sphc_v4l2_dmabuf(copying.opened.handle, &copied, &first_fd), SPHC_E_UNSUPPORTED);
}

// Without it the processor may see what the device has not written yet, or the other way round.
TEST(Camera, ReadsOfADmabufBeginWithTheLoanAndEndWithIt) {
  sphc_v4l2_config config = configFor(SPHC_STREAM_DEPTH);
  config.export_dmabuf = 1;
  RunningCamera running(depthCamera(), config);
  EXPECT_EQ(running.kernel.openReads(), 0);
  const sphc_capture first = running.opened.take();
  running.opened.take();
  EXPECT_EQ(running.kernel.openReads(), 2);
  running.opened.release(first);
  EXPECT_EQ(running.kernel.openReads(), 1);
  running.opened.stop();
  EXPECT_EQ(running.kernel.openReads(), 0);
}

TEST(Camera, BeginsAgainAfterStop) {
  RunningCamera running(depthCamera(), configFor(SPHC_STREAM_DEPTH));
  int64_t last_ns = 0;
  for (int run = 0; run < 3; ++run) {
    for (uint32_t i = 0; i < 3; ++i) {
      const sphc_capture capture = running.opened.take();
      EXPECT_EQ(capture.sequence, i);
      EXPECT_GT(capture.time_ns, last_ns);
      last_ns = capture.time_ns;
    }
    running.opened.stop();
    ASSERT_EQ(running.opened.start(), SPHC_OK) << running.opened.text();
  }
  EXPECT_EQ(running.opened.stats().captured, 9u);
}

TEST(Camera, RefusesAnotherStructSize) {
  RunningCamera running(depthCamera(), configFor(SPHC_STREAM_DEPTH));
  sphc_source source;
  ASSERT_EQ(sphc_v4l2_source(running.opened.handle, &source), SPHC_OK);
  sphc_capture capture = {};
  EXPECT_EQ(source.acquire(source.self, 0, &capture), SPHC_E_STRUCT_SIZE);
  sphc_v4l2_mode mode = {};
  EXPECT_EQ(sphc_v4l2_get_mode(running.opened.handle, &mode), SPHC_E_STRUCT_SIZE);
  sphc_v4l2_stats stats = {};
  EXPECT_EQ(sphc_v4l2_get_stats(running.opened.handle, &stats), SPHC_E_STRUCT_SIZE);
}

}  // namespace
}  // namespace sphc::v4l2
