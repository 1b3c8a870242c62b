#include "host/images/png_decode.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/random_png.h"
#include "tests/unit/host/images/beside_opencv.h"

namespace sphc::host {
namespace {

using test::areSame;
using test::kHeight;
using test::kWidth;
using test::PngKind;
using test::RandomPng;
using test::readByOpenCv;
using test::ReadImage;
using test::withPngChunk;

constexpr uint32_t kGray = 0, kRgb = 2, kPalette = 3, kGrayAlpha = 4, kRgba = 6;

// All that the specification has.
std::vector<PngKind> everyPng() {
  std::vector<PngKind> kinds;
  for (const bool is_interlaced : {false, true}) {
    for (const uint32_t depth : {1, 2, 4, 8, 16}) kinds.push_back({kGray, depth, is_interlaced});
    for (const uint32_t depth : {1, 2, 4, 8}) kinds.push_back({kPalette, depth, is_interlaced});
    for (const uint32_t type : {kRgb, kGrayAlpha, kRgba})
      for (const uint32_t depth : {8, 16}) kinds.push_back({type, depth, is_interlaced});
  }
  return kinds;
}

std::string nameOf(const PngKind &kind) {
  return "type " + std::to_string(kind.color_type) + ", " + std::to_string(kind.bit_depth) + " bits" +
         (kind.is_interlaced ? ", interlaced" : "");
}

test::ReadImage readPng(const std::vector<uint8_t> &png, sphc_format format, uint32_t width = kWidth,
                        uint32_t height = kHeight) {
  return test::readBy(decodePng, png, format, width, height);
}

bool readsAsOpenCv(const std::vector<uint8_t> &png, sphc_format format) {
  const ReadImage ours = readPng(png, format);
  return ours.decoded == Decoded::kWhole && areSame(ours.pixels, readByOpenCv(png, format));
}

TEST(PngDecode, EveryKindIsReadAsOpenCvReadsIt) {
  RandomPng random(kWidth, kHeight, 1);
  for (const PngKind &kind : everyPng())
    for (const sphc_format format : {SPHC_FORMAT_GRAY8, SPHC_FORMAT_BGR8})
      EXPECT_TRUE(readsAsOpenCv(random.of(kind), format)) << nameOf(kind) << ", format " << format;
}

TEST(PngDecode, RedComesFirstInRgb) {
  const std::vector<uint8_t> png = RandomPng(kWidth, kHeight, 2).of({kRgb, 8, false});
  const ReadImage rgb = readPng(png, SPHC_FORMAT_RGB8), bgr = readPng(png, SPHC_FORMAT_BGR8);
  ASSERT_EQ(rgb.decoded, Decoded::kWhole);
  cv::Mat swapped = rgb.pixels.clone();
  for (auto pixel = swapped.begin<cv::Vec3b>(); pixel != swapped.end<cv::Vec3b>(); ++pixel)
    std::swap((*pixel)[0], (*pixel)[2]);
  EXPECT_TRUE(areSame(swapped, bgr.pixels));
}

TEST(PngDecode, DepthAndFourChannelsAreOfOneKindAlone) {
  RandomPng random(kWidth, kHeight, 3);
  for (const PngKind &kind : everyPng()) {
    const std::vector<uint8_t> png = random.of(kind);
    if (kind.color_type == kGray && kind.bit_depth == 16)
      EXPECT_TRUE(readsAsOpenCv(png, SPHC_FORMAT_DEPTH16)) << nameOf(kind);
    else
      EXPECT_EQ(readPng(png, SPHC_FORMAT_DEPTH16).decoded, Decoded::kOfAnotherKind) << nameOf(kind);
    if (kind.color_type == kRgba && kind.bit_depth == 8)
      EXPECT_TRUE(readsAsOpenCv(png, SPHC_FORMAT_BGRA8)) << nameOf(kind);
    else
      EXPECT_EQ(readPng(png, SPHC_FORMAT_BGRA8).decoded, Decoded::kOfAnotherKind) << nameOf(kind);
  }
}

// libpng makes grey in linear light where the file names a gamma, and a camera's driver, which has none, does not.
TEST(PngDecode, WhatStandsBesideThePixelsChangesNone) {
  const std::vector<uint8_t> png = RandomPng(kWidth, kHeight, 4).of({kRgb, 8, false});
  const std::vector<uint8_t> quarter_turn = {'M', 'M', 0, 42, 0, 0, 0, 8, 0, 1, 1, 0x12, 0,
                                             3,   0,   0, 0,  1, 0, 6, 0, 0, 0, 0, 0,    0};
  const std::vector<std::pair<const char *, std::vector<uint8_t>>> chunks = {{"gAMA", {0, 0, 0xb1, 0x8f}},
                                                                             {"sRGB", {0}},
                                                                             {"bKGD", {0, 1, 0, 2, 0, 3}},
                                                                             {"sBIT", {5, 6, 5}},
                                                                             {"tRNS", {0, 1, 0, 2, 0, 3}},
                                                                             {"eXIf", quarter_turn},
                                                                             {"gAMA", {1, 2}},
                                                                             {"juNk", {1, 2}}};
  for (const sphc_format format : {SPHC_FORMAT_GRAY8, SPHC_FORMAT_BGR8})
    for (const auto &[type, data] : chunks) {
      const ReadImage with = readPng(withPngChunk(png, type, data), format);
      EXPECT_EQ(with.decoded, Decoded::kWhole) << type;
      EXPECT_TRUE(areSame(with.pixels, readPng(png, format).pixels)) << type;
    }
}

// What OpenCV takes is taken.  More is where the name alone of a chunk beside the pixels is damaged.
TEST(PngDecode, DamageIsRefusedOrLeavesThePixelsWhole) {
  RandomPng random(kWidth, kHeight, 5);
  std::mt19937 draw(5);
  uint32_t taken = 0, refused = 0;
  for (const PngKind &kind : everyPng()) {
    const std::vector<uint8_t> whole = withPngChunk(random.of(kind), "tEXt", {'a', 0, 'b'});
    const ReadImage undamaged = readPng(whole, SPHC_FORMAT_BGR8);
    for (int i = 0; i < 20; ++i) {
      std::vector<uint8_t> png = whole;
      for (size_t left = 1 + draw() % 3; left > 0; --left)
        png[draw() % (draw() % 3 == 0 ? 80 : png.size())] = static_cast<uint8_t>(draw());
      if (draw() % 8 == 0) png.resize(draw() % png.size());
      const ReadImage ours = readPng(png, SPHC_FORMAT_BGR8);
      ours.decoded == Decoded::kWhole ? ++taken : ++refused;
      if (ours.decoded == Decoded::kWhole)
        EXPECT_TRUE(areSame(ours.pixels, undamaged.pixels)) << nameOf(kind);
      else
        EXPECT_TRUE(readByOpenCv(png, SPHC_FORMAT_BGR8).empty()) << nameOf(kind);
    }
  }
  EXPECT_GT(taken, 0u);
  EXPECT_GT(refused, 300u);
}

TEST(PngDecode, AnotherSizeIsNotDecoded) {
  const std::vector<uint8_t> png = RandomPng(kWidth, kHeight, 6).of({kGray, 8, false});
  for (const int more : {-1, 1}) {
    EXPECT_EQ(readPng(png, SPHC_FORMAT_GRAY8, kWidth + more, kHeight).decoded, Decoded::kDamaged);
    EXPECT_EQ(readPng(png, SPHC_FORMAT_GRAY8, kWidth, kHeight + more).decoded, Decoded::kDamaged);
  }
}

// 100 MB in 100 kB.
TEST(PngDecode, TextThatUnpacksToMuchIsRefused) {
  std::vector<uint8_t> text = {'a', 0, 0};
  const std::vector<uint8_t> packed = test::deflated(std::vector<uint8_t>(100000000, 'x'));
  text.insert(text.end(), packed.begin(), packed.end());
  const std::vector<uint8_t> png = RandomPng(kWidth, kHeight, 7).of({kGray, 8, false});
  EXPECT_EQ(readPng(withPngChunk(png, "zTXt", text), SPHC_FORMAT_GRAY8).decoded, Decoded::kDamaged);
}

}  // namespace
}  // namespace sphc::host
