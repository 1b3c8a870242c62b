#include "host/guide/look_pace.h"

#include <gtest/gtest.h>

namespace sphc::host {
namespace {

TEST(LookPaceTest, TenFramesASecondAreDue) {
  LookPace pace;
  uint32_t looks = 0;
  for (int64_t i = 0; i < 300; ++i) {
    const int64_t time_ns = i * 33333333 + (i % 2) * 2000000;
    if (!pace.isDue(time_ns)) continue;
    pace.looked(time_ns);
    ++looks;
  }
  EXPECT_EQ(looks, 100u);
}

}  // namespace
}  // namespace sphc::host
