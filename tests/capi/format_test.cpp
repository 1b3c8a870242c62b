#include <gtest/gtest.h>

#include <cstring>

#include "spherecloud/spherecloud.h"

namespace {

bool isKnown(sphc_format format) { return std::strcmp(sphc_format_name(format), "SPHC_FORMAT_?") != 0; }

TEST(Formats, BytesOfAPixel) {
  EXPECT_EQ(sphc_format_bytes(SPHC_FORMAT_GRAY8), 1u);
  EXPECT_EQ(sphc_format_bytes(SPHC_FORMAT_RGB8), 3u);
  EXPECT_EQ(sphc_format_bytes(SPHC_FORMAT_BGR8), 3u);
  EXPECT_EQ(sphc_format_bytes(SPHC_FORMAT_RGBA8), 4u);
  EXPECT_EQ(sphc_format_bytes(SPHC_FORMAT_BGRA8), 4u);
  EXPECT_EQ(sphc_format_bytes(SPHC_FORMAT_NV12), 1u);
  EXPECT_EQ(sphc_format_bytes(SPHC_FORMAT_UYVY), 2u);
  EXPECT_EQ(sphc_format_bytes(SPHC_FORMAT_DEPTH16), 2u);
  EXPECT_EQ(sphc_format_bytes(SPHC_FORMAT_RANGE_F32), 4u);
  EXPECT_EQ(sphc_format_bytes(SPHC_FORMAT_BAYER_GBRG12), 2u);
  for (sphc_format shared : {SPHC_FORMAT_DEPTH12P, SPHC_FORMAT_RANGE12P, SPHC_FORMAT_GRAY10P, SPHC_FORMAT_GRAY12P,
                             SPHC_FORMAT_BAYER_RGGB10P, SPHC_FORMAT_BAYER_BGGR12P})
    EXPECT_EQ(sphc_format_bytes(shared), 0u) << sphc_format_name(shared);
}

TEST(Formats, BytesOfARow) {
  EXPECT_EQ(sphc_format_row_bytes(SPHC_FORMAT_RGBA8, 7), 28u);
  EXPECT_EQ(sphc_format_row_bytes(SPHC_FORMAT_I420, 641), 641u);
  EXPECT_EQ(sphc_format_row_bytes(SPHC_FORMAT_GRAY10P, 640), 800u);
  EXPECT_EQ(sphc_format_row_bytes(SPHC_FORMAT_BAYER_GRBG10P, 640), 800u);
  EXPECT_EQ(sphc_format_row_bytes(SPHC_FORMAT_DEPTH12P, 640), 960u);
  EXPECT_EQ(sphc_format_row_bytes(SPHC_FORMAT_GRAY10P, 642), 0u);  // a quarter of a group is missing
  EXPECT_EQ(sphc_format_row_bytes(SPHC_FORMAT_RANGE12P, 641), 0u);
  EXPECT_EQ(sphc_format_row_bytes(SPHC_FORMAT_RGBA8, UINT32_MAX), 0u);  // more than 32 bits
}

TEST(Formats, WhatHasANameHasBytes) {
  int known = 0;
  for (sphc_format format = -2; format < 200; ++format) {
    known += isKnown(format);
    EXPECT_EQ(sphc_format_row_bytes(format, 64) != 0, isKnown(format)) << format;
  }
  EXPECT_EQ(known, 44);
  for (sphc_format none : {INT32_MIN, -1, 0, 16, 19, 25, 31, 56, INT32_MAX}) {
    EXPECT_EQ(sphc_format_bytes(none), 0u);
    EXPECT_EQ(sphc_format_row_bytes(none, 64), 0u);
  }
}

}  // namespace
