#include "host/cameras/number_text.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace sphc::host {
namespace {

TEST(NumberText, ReadsBackToTheSameBits) {
  for (const double value : {0.1, -1.0 / 3, 1e-300, 535.91573396163199, 2e22, 5e-324})
    EXPECT_EQ(std::strtod(numberText(value).c_str(), nullptr), value);
}

TEST(NumberText, AlwaysHasAPoint) {  // YAML 1.1 takes 1e-05 for a word
  EXPECT_EQ(numberText(1e-5), "1.0e-05");
  EXPECT_EQ(numberText(640), "640.0");
  EXPECT_EQ(numberText(0.25), "0.25");
}

TEST(NumberText, Lists) { EXPECT_EQ(numbersText({1, 2.5}, " "), "1.0 2.5"); }

}  // namespace
}  // namespace sphc::host
