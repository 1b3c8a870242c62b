#include <gtest/gtest.h>

#include "spherecloud/spherecloud.h"

namespace {

TEST(Formats, BytesOfAPixel) {
  EXPECT_EQ(sphc_format_bytes(SPHC_FORMAT_GRAY8), 1u);
  EXPECT_EQ(sphc_format_bytes(SPHC_FORMAT_RGB8), 3u);
  EXPECT_EQ(sphc_format_bytes(SPHC_FORMAT_BGR8), 3u);
  EXPECT_EQ(sphc_format_bytes(SPHC_FORMAT_DEPTH16), 2u);
  for (sphc_format none : {-1, 0, 4, 11, 1000}) EXPECT_EQ(sphc_format_bytes(none), 0u);
}

}  // namespace
