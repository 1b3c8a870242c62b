#include "drivers/pixels/raw_image.h"

#include <gtest/gtest.h>

#include <vector>

namespace sphc::pixels {
namespace {

constexpr uint32_t kRawWidth = 16, kRawHeight = 8;
std::vector<uint8_t> memory(4096);

RawImage raw(Layout layout, size_t bytes) {
  return contiguous(layout, YuvRange::Limited, kRawWidth, kRawHeight, rowBytes(layout, kRawWidth), memory.data(),
                    bytes);
}

sphc_status checked(const RawImage &image) {
  sphc_message message{};
  const sphc_status status = checkRaw(image, &message);
  EXPECT_EQ(status < 0, message.text[0] != '\0') << "a failure explains itself";
  EXPECT_EQ(checkRaw(image, nullptr), status);
  return status;
}

TEST(RawImage, NeedsEveryByte) {
  const struct {
    Layout layout;
    size_t bytes;
  } cases[] = {{Layout::Grey, 128},  {Layout::Yuyv, 256},  {Layout::Uyvy, 256},   {Layout::Nv12, 192},
               {Layout::Rgb24, 384}, {Layout::Bgr24, 384}, {Layout::Bgrx32, 512}, {Layout::Depth16, 256}};
  for (const auto &needed : cases) {
    EXPECT_EQ(checked(raw(needed.layout, needed.bytes)), SPHC_OK);
    EXPECT_EQ(checked(raw(needed.layout, needed.bytes - 1)), SPHC_E_IMAGE);
    EXPECT_EQ(checked(raw(needed.layout, 0)), SPHC_E_IMAGE);
  }
}

TEST(RawImage, RefusesSizesThatCannotBe) {
  RawImage image = raw(Layout::Grey, 4096);
  image.width = 0;
  EXPECT_EQ(checked(image), SPHC_E_IMAGE);
  image.width = 8193;
  image.planes[0].stride_bytes = 8193;
  EXPECT_EQ(checked(image), SPHC_E_IMAGE);
  image = raw(Layout::Grey, 4096);
  image.height = UINT32_MAX;
  EXPECT_EQ(checked(image), SPHC_E_IMAGE);
}

TEST(RawImage, RefusesOddSizesWherePixelsShareColour) {
  RawImage image = raw(Layout::Yuyv, 4096);
  image.width = 15;
  EXPECT_EQ(checked(image), SPHC_E_IMAGE);
  image = raw(Layout::Nv12, 4096);
  image.height = 7;
  EXPECT_EQ(checked(image), SPHC_E_IMAGE);
  image = raw(Layout::Grey, 4096);
  image.width = 15;
  EXPECT_EQ(checked(image), SPHC_OK);
}

TEST(RawImage, RefusesStridesThatCannotBe) {
  RawImage image = raw(Layout::Yuyv, 4096);
  image.planes[0].stride_bytes = 31;
  EXPECT_EQ(checked(image), SPHC_E_IMAGE);
  image.planes[0].stride_bytes = UINT32_MAX;
  image.planes[0].bytes = SIZE_MAX;
  EXPECT_EQ(checked(image), SPHC_E_IMAGE);
}

TEST(RawImage, RefusesNullPlanes) {
  RawImage image = raw(Layout::Nv12, 4096);
  image.planes[1].data = nullptr;
  EXPECT_EQ(checked(image), SPHC_E_IMAGE);
  image.planes[0].data = nullptr;
  EXPECT_EQ(checked(image), SPHC_E_IMAGE);
}

TEST(OutImage, IsCheckedLikewise) {
  const OutImage fine{memory.data(), 384, kRawWidth, kRawHeight, 48, SPHC_FORMAT_RGB8};
  sphc_message message{};
  EXPECT_EQ(checkOut(fine, &message), SPHC_OK) << message.text;
  OutImage out = fine;
  out.bytes = 383;
  EXPECT_EQ(checkOut(out, &message), SPHC_E_IMAGE);
  EXPECT_STREQ(message.text,
               "the output: 383 bytes, but 8 rows at a stride of 48 take 384; cut short in transfer?");
  out = fine;
  out.stride_bytes = 47;
  EXPECT_EQ(checkOut(out, nullptr), SPHC_E_IMAGE);
  out = fine;
  out.data = nullptr;
  EXPECT_EQ(checkOut(out, nullptr), SPHC_E_IMAGE);
  out = fine;
  out.format = 7;
  EXPECT_EQ(checkOut(out, nullptr), SPHC_E_IMAGE);
}

}  // namespace
}  // namespace sphc::pixels
