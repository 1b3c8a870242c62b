#include "host/images/jpeg.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/jpeg_frame.h"
#include "tests/unit/host/images/beside_opencv.h"

namespace sphc::host {
namespace {

using test::areSame;
using test::kHeight;
using test::kWidth;
using test::readByOpenCv;
using test::ReadImage;

// Soft, with edges and noise.
cv::Mat picture(int type) {
  cv::Mat drawn(kHeight, kWidth, type), noise(kHeight, kWidth, type);
  cv::theRNG().state = 7;
  cv::randu(drawn, 0, 255);
  cv::randu(noise, 0, 30);
  cv::GaussianBlur(drawn, drawn, {}, 4);
  cv::circle(drawn, {40, 30}, 20, cv::Scalar(200, 30, 90), cv::FILLED);
  return drawn + noise;
}

std::vector<uint8_t> rgbOf(const cv::Mat &bgr) {
  cv::Mat rgb;
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  return {rgb.datastart, rgb.dataend};
}

// "turned" has a note of EXIF that asks viewers for a quarter turn.
std::vector<uint8_t> turned(std::vector<uint8_t> jpeg) {
  const std::string note(
      "\xff\xe1\x00\x22"
      "Exif\0\0MM\0\x2a\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0",
      36);
  jpeg.insert(jpeg.begin() + 2, note.begin(), note.end());
  return jpeg;
}

std::vector<std::pair<std::string, std::vector<uint8_t>>> everyJpeg() {
  const cv::Mat color = picture(CV_8UC3);
  const std::vector<uint8_t> rgb = rgbOf(color);
  const auto by = [&](int subsampling, int flags = 0, int quality = 90) {
    return test::jpegFrame(rgb, kWidth, kHeight, subsampling, quality, flags);
  };
  std::vector<uint8_t> gray, restarted;
  cv::imencode(".jpg", picture(CV_8UC1), gray);
  cv::imencode(".jpg", color, restarted, {cv::IMWRITE_JPEG_RST_INTERVAL, 3});
  return {{"4:2:0", by(TJSAMP_420)},
          {"4:2:2", by(TJSAMP_422)},
          {"4:4:4", by(TJSAMP_444)},
          {"4:4:0", by(TJSAMP_440)},
          {"4:1:1", by(TJSAMP_411)},
          {"luma alone", by(TJSAMP_GRAY)},
          {"progressive", by(TJSAMP_420, TJFLAG_PROGRESSIVE)},
          {"rough", by(TJSAMP_420, 0, 20)},
          {"without tables", test::withoutHuffmanTables(by(TJSAMP_422))},
          {"turned", turned(by(TJSAMP_420))},
          {"grey", gray},
          {"restarted", restarted}};
}

test::ReadImage readJpeg(const std::vector<uint8_t> &jpeg, sphc_format format, uint32_t width = kWidth,
                         uint32_t height = kHeight) {
  return test::readBy(decodeJpeg, jpeg, format, width, height);
}

TEST(Jpeg, EveryKindIsReadAsOpenCvReadsIt) {
  for (const auto &[name, jpeg] : everyJpeg())
    for (const sphc_format format : {SPHC_FORMAT_GRAY8, SPHC_FORMAT_BGR8}) {
      const ReadImage ours = readJpeg(jpeg, format);
      EXPECT_EQ(ours.decoded, Decoded::kWhole) << name;
      EXPECT_TRUE(areSame(ours.pixels, readByOpenCv(jpeg, format))) << name << ", format " << format;
    }
}

TEST(Jpeg, RedComesFirstInRgb) {
  const std::vector<uint8_t> jpeg = turned(test::jpegFrame(rgbOf(picture(CV_8UC3)), kWidth, kHeight));
  const ReadImage rgb = readJpeg(jpeg, SPHC_FORMAT_RGB8), bgr = readJpeg(jpeg, SPHC_FORMAT_BGR8);
  ASSERT_EQ(rgb.decoded, Decoded::kWhole);
  cv::Mat swapped;
  cv::cvtColor(rgb.pixels, swapped, cv::COLOR_RGB2BGR);
  EXPECT_TRUE(areSame(swapped, bgr.pixels));
}

// JPEG has no checksum.  What OpenCV takes is taken, and what both take is the same.
TEST(Jpeg, DamageIsTakenAsOpenCvTakesIt) {
  std::mt19937 draw(5);
  uint32_t taken = 0, refused = 0;
  for (const auto &[name, whole] : everyJpeg())
    for (int i = 0; i < 200; ++i) {
      std::vector<uint8_t> jpeg = whole;
      for (size_t left = 1 + draw() % 3; left > 0; --left)
        jpeg[2 + draw() % ((draw() % 3 == 0 ? 600 : jpeg.size()) - 4)] = static_cast<uint8_t>(draw());
      const cv::Mat theirs = readByOpenCv(jpeg, SPHC_FORMAT_BGR8);
      const ReadImage ours = readJpeg(jpeg, SPHC_FORMAT_BGR8);
      if (theirs.size() != cv::Size(kWidth, kHeight)) {
        refused += ours.decoded == Decoded::kDamaged;
        continue;
      }
      ++taken;
      EXPECT_EQ(ours.decoded, Decoded::kWhole) << name;
      EXPECT_TRUE(areSame(ours.pixels, theirs)) << name;
    }
  EXPECT_GT(taken, 1000u);
  EXPECT_GT(refused, 100u);
}

// TurboJPEG calls it a warning.
TEST(Jpeg, AFailureBehindAWarningIsNoImage) {
  std::vector<uint8_t> jpeg =
      test::jpegFrame(rgbOf(picture(CV_8UC3)), kWidth, kHeight, TJSAMP_420, 90, TJFLAG_PROGRESSIVE);
  const std::vector<uint8_t> scan = {0xff, 0xda};
  const auto first = std::search(jpeg.begin(), jpeg.end(), scan.begin(), scan.end());
  const auto last = std::find_end(jpeg.begin(), jpeg.end(), scan.begin(), scan.end());
  ASSERT_LT(first, last);
  *(last + 4) = 9;  // channels, of at most four
  const size_t in_first = static_cast<size_t>(first - jpeg.begin()) + 30;
  jpeg[in_first] = 0xff;
  jpeg[in_first + 1] = 0xd0;  // a mark that does not belong there
  EXPECT_EQ(readJpeg(jpeg, SPHC_FORMAT_BGR8).decoded, Decoded::kDamaged);
}

TEST(Jpeg, ColoursOfPrintAreOfAnotherKind) {
  const std::vector<uint8_t> jpeg = test::cmykJpeg(kWidth, kHeight);
  for (const sphc_format format : {SPHC_FORMAT_GRAY8, SPHC_FORMAT_BGR8})
    EXPECT_EQ(readJpeg(jpeg, format).decoded, Decoded::kOfAnotherKind);
}

// TurboJPEG alone would scale it.
TEST(Jpeg, AnotherSizeIsNotDecoded) {
  const std::vector<uint8_t> jpeg = test::jpegFrame(rgbOf(picture(CV_8UC3)), kWidth, kHeight);
  EXPECT_EQ(readJpeg(jpeg, SPHC_FORMAT_BGR8, 2 * kWidth, 2 * kHeight).decoded, Decoded::kDamaged);
  EXPECT_EQ(readJpeg(jpeg, SPHC_FORMAT_BGR8, kWidth / 2 + 1, kHeight / 2 + 1).decoded, Decoded::kDamaged);
}

TEST(Jpeg, NoDepthIsReadOrMade) {
  const std::vector<uint8_t> jpeg = test::jpegFrame(rgbOf(picture(CV_8UC3)), kWidth, kHeight);
  std::vector<uint8_t> depth(2 * kWidth * kHeight), made;
  EXPECT_EQ(decodeJpeg(jpeg.data(), jpeg.size(), {depth.data(), kWidth, kHeight, SPHC_FORMAT_DEPTH16}),
            Decoded::kOfAnotherKind);
  EXPECT_FALSE(encodeJpeg({depth.data(), kWidth, kHeight, 2 * kWidth, SPHC_FORMAT_DEPTH16}, 90, &made));
}

TEST(Jpeg, FilesAreThoseOfOpenCv) {
  for (const int type : {CV_8UC1, CV_8UC3})
    for (const int quality : {0, 1, 50, 88, 95, 100}) {
      cv::Mat wide(kHeight, kWidth + 5, type, cv::Scalar::all(77));
      const cv::Mat inside = wide.colRange(0, kWidth);  // rows with something behind them
      picture(type).copyTo(inside);
      std::vector<uint8_t> ours, theirs;
      cv::imencode(".jpg", inside, theirs, {cv::IMWRITE_JPEG_QUALITY, quality});
      const sphc_image image = {inside.data, kWidth, kHeight, static_cast<uint32_t>(inside.step),
                                type == CV_8UC1 ? SPHC_FORMAT_GRAY8 : SPHC_FORMAT_BGR8};
      ASSERT_TRUE(encodeJpeg(image, static_cast<uint32_t>(quality), &ours));
      EXPECT_EQ(ours, theirs) << quality;
    }
}

TEST(Jpeg, RgbMakesTheSameFileAsBgr) {
  const cv::Mat bgr = picture(CV_8UC3);
  const std::vector<uint8_t> rgb = rgbOf(bgr);
  std::vector<uint8_t> of_bgr, of_rgb;
  ASSERT_TRUE(encodeJpeg({bgr.data, kWidth, kHeight, 3 * kWidth, SPHC_FORMAT_BGR8}, 90, &of_bgr));
  ASSERT_TRUE(encodeJpeg({rgb.data(), kWidth, kHeight, 3 * kWidth, SPHC_FORMAT_RGB8}, 90, &of_rgb));
  EXPECT_EQ(of_bgr, of_rgb);
}

}  // namespace
}  // namespace sphc::host
