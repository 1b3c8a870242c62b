#include "runtime/base/elementary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

constexpr int kTrials = 200000;
#ifdef _WIN32  // whose own sine is off by as much at large angles
constexpr double kMostOff = 2e-15;
#else
constexpr double kMostOff = 1e-15;
#endif

TEST(Elementary, SinCosMatchesLibmOverItsRange) {
  Random random(1);
  double worst_small = 0, worst = 0;
  for (int i = 0; i < kTrials; ++i) {
    const bool small = i % 2;
    const double x = small ? test::uniformIn(&random, -10, 10) : test::uniformIn(&random, -1e6, 1e6);
    double s, c;
    sinCos(x, &s, &c);
    const double error = std::max(std::abs(s - std::sin(x)), std::abs(c - std::cos(x)));
    (small ? worst_small : worst) = std::max(small ? worst_small : worst, error);
    EXPECT_NEAR(s * s + c * c, 1, 1e-15);
  }
  EXPECT_LT(worst_small, 1e-15);
  EXPECT_LT(worst, kMostOff);
}

TEST(Elementary, SinCosAtTheQuarters) {
  double s, c;
  sinCos(0, &s, &c);
  EXPECT_EQ(s, 0);
  EXPECT_EQ(c, 1);
  for (int k = -8; k <= 8; ++k) {
    sinCos(k * kPi / 2, &s, &c);
    EXPECT_NEAR(s, std::sin(k * kPi / 2), 1e-15);
    EXPECT_NEAR(c, std::cos(k * kPi / 2), 1e-15);
  }
}

TEST(Elementary, Atan2MatchesLibmInAllQuadrantsAndScales) {
  Random random(2);
  double worst = 0;
  for (int i = 0; i < kTrials; ++i) {
    const double scale = std::pow(10, test::uniformIn(&random, -12, 12));
    const double y = test::normal(&random) * scale, x = test::normal(&random) * (i % 3 ? scale : 1);
    worst = std::max(worst, std::abs(atan2Of(y, x) - std::atan2(y, x)));
  }
  EXPECT_LT(worst, 1e-15);
}

TEST(Elementary, Atan2OnTheAxes) {
  EXPECT_EQ(atan2Of(0, 0), 0);
  EXPECT_EQ(atan2Of(0, 1), 0);
  EXPECT_NEAR(atan2Of(0, -1), kPi, 1e-15);
  EXPECT_NEAR(atan2Of(1, 0), kPi / 2, 1e-15);
  EXPECT_NEAR(atan2Of(-1, 0), -kPi / 2, 1e-15);
}

TEST(Elementary, ExpMatchesLibm) {
  Random random(3);
  double worst = 0;
  for (int i = 0; i < kTrials; ++i) {
    const double x = i % 2 ? test::uniformIn(&random, -700, 700) : test::uniformIn(&random, -2, 2);
    worst = std::max(worst, std::abs(expOf(x) / std::exp(x) - 1));
  }
  EXPECT_LT(worst, 1e-14);
  EXPECT_EQ(expOf(0), 1);
  EXPECT_EQ(expOf(-800), 0);
  EXPECT_TRUE(isFinite(expOf(800)));
}

TEST(Elementary, LogMatchesLibm) {
  Random random(4);
  double worst = 0;
  for (int i = 0; i < kTrials; ++i) {
    const double x = i % 2 ? std::exp(test::uniformIn(&random, -700, 700)) : test::uniformIn(&random, 0.5, 2);
    const double scale = std::max(1.0, std::abs(std::log(x)));
    worst = std::max(worst, std::abs(logOf(x) - std::log(x)) / scale);
  }
  EXPECT_LT(worst, 1e-14);
  EXPECT_EQ(logOf(1), 0);
}

TEST(Elementary, Floors) {
  for (double x : {-3.0, -2.5, -0.1, 0.0, 0.1, 2.999999, 3.0, 1e15 + 0.5}) {
    EXPECT_EQ(floorOf(x), std::floor(x)) << x;
    if (std::abs(x) < 1e6) {
      EXPECT_EQ(floorToInt(static_cast<float>(x)), static_cast<int32_t>(std::floor(static_cast<float>(x)))) << x;
    }
  }
}

TEST(Elementary, Finiteness) {
  EXPECT_TRUE(isFinite(0));
  EXPECT_TRUE(isFinite(-std::numeric_limits<double>::max()));
  EXPECT_FALSE(isFinite(std::numeric_limits<double>::infinity()));
  EXPECT_FALSE(isFinite(-std::numeric_limits<double>::infinity()));
  EXPECT_FALSE(isFinite(std::numeric_limits<double>::quiet_NaN()));
}

}  // namespace
}  // namespace sphc
