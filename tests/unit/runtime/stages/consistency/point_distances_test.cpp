#include "runtime/stages/consistency/point_distances.h"

#include <gtest/gtest.h>

#include <vector>

namespace sphc {
namespace {

constexpr double kVariance = 0.01 * 0.01;
constexpr int64_t kSecondNs = 1000000000;
constexpr uint32_t kPoints = 20;

class PointDistancesTest : public testing::Test {
 protected:
  PointDistancesTest() {
    Arena measured;
    PointDistances::layout(measured, nullptr);
    memory_.resize(measured.used() / sizeof memory_[0] + 1);
    Arena state(static_cast<void *>(memory_.data()));
    PointDistances::layout(state, &distances_);
    distances_.reset();
  }
  static PointDistance seen(uint32_t point, double distance_m) { return {point, distance_m, kVariance}; }
  // A frame that sees points at these distances, so many metres farther for those before `moved`; kept.
  bool look(double centre_x_m, int64_t time_ns, double off_m = 0, uint32_t moved = 0, uint32_t first = 0) {
    distances_.begin(Vector3(centre_x_m, 0, 0), time_ns);
    for (const bool keeps : {false, true})
      for (uint32_t i = 0; i < kPoints; ++i) {
        const PointDistance point = seen(first + i, 2 + 0.1 * i + (i < moved ? off_m : 0));
        keeps ? distances_.keep(point) : distances_.compare(point);
      }
    return distances_.disagree();
  }

  struct alignas(kArenaAlignment) Line {
    unsigned char bytes[kArenaAlignment];
  };
  std::vector<Line> memory_;
  PointDistances distances_;
};

TEST_F(PointDistancesTest, WhatStandsStillAgrees) {
  EXPECT_FALSE(look(0, 0)) << "there is nothing to compare with";
  EXPECT_FALSE(look(0.2, kSecondNs));
  EXPECT_FALSE(look(0.4, 2 * kSecondNs, 0.02, kPoints)) << "1.4 sigmas";
}

TEST_F(PointDistancesTest, MostPointsMustLieElsewhere) {
  look(0, 0);
  EXPECT_FALSE(look(0.2, kSecondNs, 0.1, kPoints / 2));
  EXPECT_TRUE(look(0.2, kSecondNs, 0.1, kPoints / 2 + 1));
  EXPECT_TRUE(look(0.2, kSecondNs, -0.1, kPoints));
}

TEST_F(PointDistancesTest, TheFirstWordIsKept) {
  look(0, 0);
  EXPECT_TRUE(look(0.2, kSecondNs, 0.1, kPoints));
  EXPECT_FALSE(look(0.4, 2 * kSecondNs));
}

TEST_F(PointDistancesTest, FromTheSamePlaceNothingIsCompared) {
  look(0, 0);
  EXPECT_FALSE(look(0.04, kSecondNs, 0.5, kPoints));
}

TEST_F(PointDistancesTest, FewPointsSayNothing) {
  look(0, 0);
  EXPECT_FALSE(look(0.2, kSecondNs, 0.5, kPoints, kPoints - 5)) << "five points are known";
  EXPECT_TRUE(look(0.4, kSecondNs, 0.5, kPoints, kPoints - 6)) << "and now more";
}

TEST_F(PointDistancesTest, WhatIsOldOrOfLaterTimesIsForgotten) {
  look(0, 0);
  EXPECT_TRUE(look(0.2, 10 * kSecondNs, 0.5, kPoints));
  EXPECT_FALSE(look(0.4, 11 * kSecondNs, 0.5, kPoints));
  EXPECT_TRUE(look(0.6, 12 * kSecondNs)) << "what replaced it";
  EXPECT_FALSE(look(0.8, kSecondNs)) << "the clock went back";
}

TEST_F(PointDistancesTest, PointsShareTheirPlaces) {
  look(0, 0);
  look(0.2, kSecondNs, 0, 0, 512);
  EXPECT_FALSE(look(0.4, 2 * kSecondNs, 0.5, kPoints)) << "they gave way to others";
}

}  // namespace
}  // namespace sphc
