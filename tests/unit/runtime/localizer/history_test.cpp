#include "runtime/localizer/history.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/arena_memory.h"

namespace sphc {
namespace {

class HistoryTest : public testing::Test {
 protected:
  HistoryTest()
      : memory_([this](Arena &state, bool has_memory) {
          History::layout(kCapacity, state, has_memory ? &history_ : nullptr);
        }) {}
  static LiftedPoint pointAt(double x_m, double z_m) { return {Vector3(x_m, 0, z_m), 0.005, 0.02}; }

  static constexpr uint32_t kCapacity = 8;
  History history_;
  test::ArenaMemory memory_;
};

TEST_F(HistoryTest, PointsFollowTheCameraAndGetVaguer) {
  history_.add(pointAt(0.5, 2), 7, 0.3f);
  const Rigid now_from_before = {rotationFromVector(Vector3(0, 0.2, 0)), Vector3(-0.1, 0, 0.05)};
  history_.advance(now_from_before, 0.001, 0.002);
  ASSERT_EQ(history_.matches().size(), 1u);
  const OldMatch &match = history_.matches()[0];
  EXPECT_LT((match.lifted.point_m - now_from_before * Vector3(0.5, 0, 2)).norm(), 1e-12);
  EXPECT_EQ(match.point_index, 7u);
  EXPECT_EQ(match.age, 1u);
  EXPECT_GT(match.lifted.sideways_m, 0.005);
  EXPECT_GT(match.lifted.along_m, 0.02);
  EXPECT_LT(match.lifted.along_m, 0.021);
}

TEST_F(HistoryTest, WhatOdometryDriftedByIsThatOfEarlierMatches) {
  double turn_rad = 1, shift_m = 1;
  history_.add(pointAt(0.5, 2), 7, 0);
  history_.driftOfEarlier(&turn_rad, &shift_m);
  EXPECT_EQ(turn_rad, 0);
  EXPECT_EQ(shift_m, 0);
  for (int i = 0; i < 4; ++i) history_.advance({}, 1e-3, 2e-3);
  history_.add(pointAt(0.4, 2), 8, 0);
  history_.driftOfEarlier(&turn_rad, &shift_m);
  EXPECT_NEAR(turn_rad, 2e-3, 1e-12);
  EXPECT_NEAR(shift_m, 4e-3, 1e-12);
}

TEST_F(HistoryTest, DepthErrorSeenFromTheSideIsSideways) {
  history_.add({Vector3(0, 0, 1), 0.001, 0.02}, 1, 0);
  // around the point by a right angle: what was along is across now
  const Rigid around = {rotationFromVector(Vector3(0, kPi / 2, 0)), Vector3(-1, 0, 1)};
  history_.advance(around, 1e-6, 1e-6);
  ASSERT_EQ(history_.matches().size(), 1u);
  EXPECT_LT((history_.matches()[0].lifted.point_m - Vector3(0, 0, 1)).norm(), 1e-9);
  EXPECT_NEAR(history_.matches()[0].lifted.sideways_m, 0.02, 0.0002);
}

TEST_F(HistoryTest, ManySmallStepsAreAsOneLarge) {
  constexpr int kSteps = 60;
  history_.add({Vector3(0, 0, 1), 0.005, 0.03}, 1, 0);
  const auto around = [](double angle) {  // the point
    const Matrix3 turn = rotationFromVector(Vector3(0, angle, 0));
    return Rigid{turn, Vector3(0, 0, 1) - turn * Vector3(0, 0, 1)};
  };
  for (int i = 0; i < kSteps; ++i) history_.advance(around(kPi / 6 / kSteps), 1e-6, 1e-6);
  ASSERT_EQ(history_.matches().size(), 1u);
  EXPECT_NEAR(history_.matches()[0].lifted.sideways_m, std::hypot(0.005, 0.03 * 0.5), 1e-5);
  EXPECT_NEAR(history_.matches()[0].lifted.along_m, std::hypot(0.005, 0.03 * std::sqrt(0.75)), 1e-5);
}

TEST_F(HistoryTest, AMapPointCountsOnce) {
  history_.add(pointAt(0, 1), 7, 0);
  history_.advance(Rigid(), 1e-4, 1e-4);
  history_.add(pointAt(0.1, 1), 7, 0);
  ASSERT_EQ(history_.matches().size(), 1u);
  EXPECT_EQ(history_.matches()[0].age, 0u);
  EXPECT_EQ(history_.frames(), 1u);
}

TEST_F(HistoryTest, TheOldestMakesRoom) {
  history_.add(pointAt(0, 1), 100, 0);
  history_.advance(Rigid(), 1e-4, 1e-4);
  for (uint32_t i = 0; i < kCapacity; ++i) history_.add(pointAt(0, 1), i, 0);
  EXPECT_EQ(history_.matches().size(), size_t{kCapacity});
  for (const OldMatch &match : history_.matches()) EXPECT_NE(match.point_index, 100u);
}

TEST_F(HistoryTest, CountsFramesAndForgets) {
  for (uint32_t i = 0; i < 3; ++i) {
    history_.add(pointAt(0, 1), i, 0);
    history_.advance(Rigid(), 1e-6, 1e-6);
  }
  EXPECT_EQ(history_.frames(), 3u);
  history_.advance(Rigid(), 0.1, 0.1);  // too vague
  EXPECT_EQ(history_.matches().size(), 0u);
  history_.add(pointAt(0, 1), 1, 0);
  for (int i = 0; i < 61; ++i) history_.advance(Rigid(), 1e-6, 1e-6);  // too old
  EXPECT_EQ(history_.matches().size(), 0u);
}

TEST_F(HistoryTest, ErrorsOfOdometryAreErrorsOfThePoint) {
  history_.add(pointAt(0, 2), 7, 0);
  history_.advance(Rigid(), 0.003, 0.004);
  ASSERT_EQ(history_.matches().size(), 1u);
  const LiftedPoint &later = history_.matches()[0].lifted;
  EXPECT_NEAR(later.sideways_m, std::hypot(0.005, 0.003 * 2, 0.004), 1e-12);
  EXPECT_NEAR(later.along_m, std::hypot(later.sideways_m, 0.02), 1e-12);
}

TEST_F(HistoryTest, AFurtherCameraStandsElsewhereNow) {
  LiftedPoint seen = pointAt(0, 2);
  seen.centre_m = {0.1f, 0, 0};
  history_.add(seen, 7, 0);
  ASSERT_EQ(history_.matches().size(), 1u);
  EXPECT_TRUE(history_.matches()[0].lifted.centre_m.isZero(0));
}

TEST_F(HistoryTest, TheOldestMakesRoomWhereverItLies) {
  history_.add(pointAt(0, 1), 100, 0);
  history_.add(pointAt(0, 1), 101, 0);
  history_.advance(Rigid(), 1e-4, 1e-4);
  history_.add(pointAt(0, 1), 100, 0);  // seen again
  for (uint32_t i = 0; i + 1 < kCapacity; ++i) history_.add(pointAt(0, 1), i, 0);
  bool has_100 = false;
  for (const OldMatch &match : history_.matches()) {
    EXPECT_NE(match.point_index, 101u);
    has_100 = has_100 || match.point_index == 100;
  }
  EXPECT_TRUE(has_100);
}

}  // namespace
}  // namespace sphc
