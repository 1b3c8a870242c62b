#include "runtime/stages/consistency/travel.h"

#include <gtest/gtest.h>

#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

constexpr double kSigmaM = 0.003, kStepM = 0.0005;

Travel walked(double scale, double length_m, int places, double step_m = kStepM, double sigma_m = kSigmaM) {
  Travel travel;
  for (int i = 0; i < places; ++i) {
    const double at = length_m * i / places;
    const Vector3 odometry(at, 0.1 * at, 0.3 * at * at);
    const Vector3 map = scale * Vector3(-odometry.y(), odometry.x(), odometry.z()) + Vector3(1, 2, 3);
    travel.add(map, odometry, sigma_m, step_m * step_m);
  }
  return travel;
}

TEST(Travel, AnotherScaleIsSeen) {
  for (const double scale : {0.5, 0.92, 1.1, 2.0}) EXPECT_TRUE(walked(scale, 2, 30).isScaled()) << scale;
  for (const double scale : {0.96, 1.0, 1.04}) EXPECT_FALSE(walked(scale, 2, 30).isScaled()) << scale;
}

// 17 cm are 5 cm about their mean: half the way is told from what poses are off there, a tenth is not.
TEST(Travel, AShortWayTellsALargeChangeAlone) {
  EXPECT_TRUE(walked(0.5, 0.17, 30).isScaled());
  EXPECT_FALSE(walked(1.1, 0.17, 30).isScaled());
  EXPECT_FALSE(walked(0.5, 0.05, 30).isScaled());
  EXPECT_FALSE(walked(0.5, 2, 3).isScaled()) << "too few places";
}

// 30 steps of 2 cm lead off by as much as half the way does.
TEST(Travel, OdometryThatDriftsIsNotBelieved) {
  EXPECT_TRUE(walked(0.7, 0.3, 30, 0.002).isScaled());
  EXPECT_FALSE(walked(0.7, 0.3, 30, 0.02).isScaled());
}

TEST(Travel, WhoStandsStillIsNotScaled) {
  Travel still, shaken;
  for (int i = 0; i < 30; ++i) {
    still.add(Vector3::Zero(), Vector3::Zero(), kSigmaM, kStepM * kStepM);
    shaken.add(Vector3(0.004 * (i % 3), 0, 0), Vector3(0.0001 * (i % 2), 0, 0), kSigmaM, kStepM * kStepM);
  }
  EXPECT_FALSE(still.isScaled());
  EXPECT_FALSE(shaken.isScaled()) << "poses are off by their sigma";
}

// A head that holds still, by odometry that wanders as it says: 2 cm a step lead metres away.
TEST(Travel, WhoStandsStillIsNotScaledByWhatOdometryIsOff) {
  for (const double step_m : {0.002, 0.005, 0.02}) {
    Random random(1);
    Travel still;
    Vector3 odometry_m = Vector3::Zero();
    for (int i = 0; i < 300; ++i) {
      odometry_m += step_m * test::normalVector(&random);
      still.add(0.001 * test::normalVector(&random), odometry_m, kSigmaM, step_m * step_m);
      EXPECT_FALSE(still.isScaled()) << step_m << " after " << i;
    }
  }
  EXPECT_TRUE(walked(0.2, 2, 30, 0.02).isScaled()) << "a way that is more than that";
}

TEST(Travel, ForgetsWhatLiesFarBack) {
  Travel travel = walked(1.3, 2, 30);
  EXPECT_TRUE(travel.isScaled());
  for (int i = 0; i < 64; ++i)
    travel.add(Vector3(0.03 * i, 0, 0), Vector3(0.03 * i, 0, 0), kSigmaM, kStepM * kStepM);
  EXPECT_FALSE(travel.isScaled());
}

TEST(Travel, VaguePosesTellNoScale) {
  EXPECT_TRUE(walked(1.2, 0.6, 30, kStepM, 0.003).isScaled());
  EXPECT_FALSE(walked(1.2, 0.6, 30, kStepM, 0.05).isScaled());
}

}  // namespace
}  // namespace sphc
