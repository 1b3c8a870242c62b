#include "drivers/pixels/mjpeg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "tests/support/jpeg_frame.h"

namespace sphc::pixels {
namespace {

using ::testing::HasSubstr;

constexpr uint32_t kJpegWidth = 48, kJpegHeight = 32;

struct Decoded {
  sphc_status status;
  std::vector<uint8_t> pixels;
  sphc_message message;
};

Decoded decode(const std::vector<uint8_t> &frame, sphc_format format = SPHC_FORMAT_RGB8) {
  static MjpegDecoder decoder;  // one for all, as in a driver: a bad frame must not spoil the next
  const uint32_t stride = sphc_format_bytes(format) * kJpegWidth;
  Decoded decoded{SPHC_OK, std::vector<uint8_t>(stride * kJpegHeight), {}};
  const OutImage out{decoded.pixels.data(), decoded.pixels.size(), kJpegWidth, kJpegHeight, stride, format};
  decoded.status = decoder.decode(frame.data(), frame.size(), out, &decoded.message);
  EXPECT_EQ(decoded.status < 0, decoded.message.text[0] != '\0') << "a failure explains itself";
  return decoded;
}

const std::vector<uint8_t> kRgb = test::gradientRgb(kJpegWidth, kJpegHeight);
const std::vector<uint8_t> kFrame = test::jpegFrame(kRgb, kJpegWidth, kJpegHeight);

// Before its end mark.
std::vector<uint8_t> padded(std::vector<uint8_t> frame) {
  frame.insert(frame.end() - 2, 7, uint8_t{0});
  return frame;
}

TEST(Mjpeg, DecodesEverySubsampling) {
  for (const int subsampling : {TJSAMP_444, TJSAMP_422, TJSAMP_420}) {
    const Decoded rgb = decode(test::jpegFrame(kRgb, kJpegWidth, kJpegHeight, subsampling));
    ASSERT_EQ(rgb.status, SPHC_OK) << rgb.message.text;
    for (size_t i = 0; i < kRgb.size(); ++i) ASSERT_NEAR(rgb.pixels[i], kRgb[i], 8) << "byte " << i;
  }
}

TEST(Mjpeg, OrdersColours) {
  const Decoded rgb = decode(kFrame), bgr = decode(kFrame, SPHC_FORMAT_BGR8),
                gray = decode(kFrame, SPHC_FORMAT_GRAY8);
  ASSERT_EQ(rgb.status + bgr.status + gray.status, SPHC_OK);
  for (size_t i = 0; i < kJpegWidth * kJpegHeight; ++i) {
    for (size_t c = 0; c < 3; ++c) ASSERT_EQ(rgb.pixels[3 * i + c], bgr.pixels[3 * i + 2 - c]);
    const double luma = 0.299 * rgb.pixels[3 * i] + 0.587 * rgb.pixels[3 * i + 1] + 0.114 * rgb.pixels[3 * i + 2];
    ASSERT_NEAR(gray.pixels[i], luma, 2);
  }
}

TEST(Mjpeg, NeedsNoHuffmanTablesAndIgnoresWhatFollowsTheEnd) {
  const std::vector<uint8_t> bare = test::withoutHuffmanTables(kFrame);
  ASSERT_LT(bare.size() + 400, kFrame.size());
  EXPECT_EQ(decode(bare).pixels, decode(kFrame).pixels);
  std::vector<uint8_t> padded = kFrame;
  padded.resize(padded.size() + 1000);
  EXPECT_EQ(decode(padded).pixels, decode(kFrame).pixels);
}

TEST(Mjpeg, TakesPaddingBeforeTheEndMark) {
  const Decoded decoded = decode(padded(kFrame));
  EXPECT_EQ(decoded.status, SPHC_OK) << decoded.message.text;
  EXPECT_EQ(decoded.pixels, decode(kFrame).pixels);
}

TEST(Mjpeg, TakesPaddingWhateverTheImageEndsWith) {
  for (const int value : {0x5a, 0xa5, 0, 0xff}) {
    const std::vector<uint8_t> flat(kRgb.size(), static_cast<uint8_t>(value));
    const Decoded decoded = decode(padded(test::jpegFrame(flat, kJpegWidth, kJpegHeight)));
    EXPECT_EQ(decoded.status, SPHC_OK) << value << ": " << decoded.message.text;
    EXPECT_EQ(decoded.pixels, flat);
  }
}

// The decoder looks for the end mark before it writes a row: the image would be the last frame's.
TEST(Mjpeg, RefusesAPaddedFrameOfWhichNoRowIsWritten) {
  const auto frame = test::jpegFrame(kRgb, kJpegWidth, kJpegHeight, TJSAMP_422, 95, TJFLAG_PROGRESSIVE);
  EXPECT_EQ(decode(frame).status, SPHC_OK);
  EXPECT_EQ(decode(padded(frame)).status, SPHC_E_IMAGE);
}

// As when packets are lost: what is left of one part looks like padding, and the rows behind it would be the last
// frame's.
TEST(Mjpeg, RefusesAFrameWithRestartMarksThatIsCutAndPadded) {
  setenv("TJ_RESTART", "1", 1);  // of the encoder: a mark behind each row of blocks
  const std::vector<uint8_t> frame = test::jpegFrame(kRgb, kJpegWidth, kJpegHeight);
  unsetenv("TJ_RESTART");
  EXPECT_EQ(decode(padded(frame)).pixels, decode(kFrame).pixels);
  const uint8_t mark[] = {0xff, 0xd0}, end[] = {0xff, 0xd9};
  const auto first = std::search(frame.begin(), frame.end(), mark, mark + 2);
  ASSERT_NE(first, frame.end());
  std::vector<uint8_t> cut(frame.begin(), first);
  cut.insert(cut.end(), end, end + 2);
  EXPECT_EQ(decode(padded(cut)).status, SPHC_E_IMAGE);
}

TEST(Mjpeg, RefusesAFrameCutAnywhereBeforeItsEndMark) {
  for (size_t bytes = 0; bytes + 2 <= kFrame.size(); ++bytes)
    ASSERT_EQ(decode({kFrame.begin(), kFrame.begin() + static_cast<long>(bytes)}).status, SPHC_E_IMAGE) << bytes;
  EXPECT_EQ(decode(kFrame).status, SPHC_OK);
}

TEST(Mjpeg, RefusesWhatIsNoJpeg) {
  EXPECT_EQ(decode(std::vector<uint8_t>(5000)).status, SPHC_E_IMAGE);
  EXPECT_EQ(decode(std::vector<uint8_t>(5000, 0xff)).status, SPHC_E_IMAGE);
}

TEST(Mjpeg, NoticesAnEndInTheMiddle) {  // as when packets are lost
  std::vector<uint8_t> torn = kFrame;
  torn[torn.size() - 40] = 0xff;
  torn[torn.size() - 39] = 0xd9;
  const Decoded decoded = decode(torn);
  EXPECT_EQ(decoded.status, SPHC_E_IMAGE);
  EXPECT_THAT(decoded.message.text, HasSubstr("the frame is left out"));
}

TEST(Mjpeg, IsNotSpoiltByABadFrame) {  // TurboJPEG alone is, by one that ends in its header
  for (size_t bytes = 0; bytes + 2 <= kFrame.size(); ++bytes) {
    ASSERT_EQ(decode({kFrame.begin(), kFrame.begin() + static_cast<long>(bytes)}).status, SPHC_E_IMAGE) << bytes;
    ASSERT_EQ(decode(kFrame).status, SPHC_OK) << bytes;
  }
}

TEST(Mjpeg, RefusesAnotherSize) {
  const Decoded decoded = decode(test::jpegFrame(test::gradientRgb(64, 32), 64, 32));
  EXPECT_EQ(decoded.status, SPHC_E_IMAGE);
  EXPECT_STREQ(decoded.message.text, "JPEG frame of 64 x 32 pixels; 48 x 32 were negotiated");
}

TEST(Mjpeg, RefusesDepthAndWhatDriversDoNotDeliver) {
  EXPECT_EQ(decode(kFrame, SPHC_FORMAT_DEPTH16).status, SPHC_E_UNSUPPORTED);
  for (const sphc_format format : {SPHC_FORMAT_RGBA8, SPHC_FORMAT_NV12})
    EXPECT_EQ(decode(kFrame, format).status, SPHC_E_IMAGE) << format;
}

}  // namespace
}  // namespace sphc::pixels
