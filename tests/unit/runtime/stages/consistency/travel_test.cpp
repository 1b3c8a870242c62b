#include "runtime/stages/consistency/travel.h"

#include <gtest/gtest.h>

#include "runtime/base/elementary.h"

namespace sphc {
namespace {

constexpr double kSigmaM = 0.003;

Travel walked(double scale, double length_m, int places) {
  Travel travel;
  for (int i = 0; i < places; ++i) {
    const double at = length_m * i / places;
    const Vector3 odometry(at, 0.1 * at, 0.3 * at * at);
    const Vector3 map = scale * Vector3(-odometry.y(), odometry.x(), odometry.z()) + Vector3(1, 2, 3);
    travel.add(map, odometry, kSigmaM);
  }
  return travel;
}

TEST(Travel, MeasuresTheScale) {
  EXPECT_NEAR(walked(1.1, 2, 30).scale(), 1.1, 1e-9);
  EXPECT_TRUE(walked(1.1, 2, 30).isScaled());
  EXPECT_TRUE(walked(0.5, 2, 30).isScaled());
}

TEST(Travel, TheSameWayIsNotScaled) { EXPECT_FALSE(walked(1, 2, 30).isScaled()); }

TEST(Travel, AShortWaySaysNothing) {
  EXPECT_EQ(walked(1.1, 0.05, 30).scale(), 0);
  EXPECT_FALSE(walked(0.5, 0.05, 30).isScaled());
  EXPECT_FALSE(walked(0.5, 2, 3).isScaled());
}

TEST(Travel, ForgetsWhatLiesFarBack) {
  Travel travel = walked(1.3, 2, 30);
  for (int i = 0; i < 64; ++i) travel.add(Vector3(0.03 * i, 0, 0), Vector3(0.03 * i, 0, 0), kSigmaM);
  EXPECT_NEAR(travel.scale(), 1, 1e-9);
}

}  // namespace
}  // namespace sphc
