#include "host/report/hint_words.h"

#include <gtest/gtest.h>
#include <spherecloud/spherecloud.h>

namespace sphc::host {
namespace {

TEST(HintWords, EachBitHasAName) {
  for (uint32_t bit = SPHC_HINT_TOO_DARK; bit <= SPHC_HINT_AMBIGUOUS; bit <<= 1)
    EXPECT_NE(hintNames(bit), "") << bit;
  EXPECT_EQ(hintNames(0), "");
  EXPECT_EQ(hintNames(SPHC_HINT_TOO_DARK | SPHC_HINT_AMBIGUOUS), "too dark, ambiguous");
}

}  // namespace
}  // namespace sphc::host
