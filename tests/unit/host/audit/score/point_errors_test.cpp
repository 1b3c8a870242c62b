#include "host/audit/score/point_errors.h"

#include <gtest/gtest.h>

namespace sphc::host {
namespace {

const std::vector<Vector3> kTruth = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
const std::vector<uint32_t> kLineOfPoint = {1, 0, 0};
const std::vector<Vector3> kRecovered = {{1, 0, 0.5}, {0, 0, 3}};

TEST(PointErrors, AreOfEachPoint) {
  EXPECT_EQ(pointErrors({kTruth[0], kTruth[1]}, {1, 0}, kRecovered), (std::vector<double>{3, 0.5}));
}

TEST(PointErrors, OfALineWithTwoPointsTheNearerCounts) {
  EXPECT_EQ(nearestPointErrors(kTruth, kLineOfPoint, kRecovered), (std::vector<double>{0.5, 3}));
}

TEST(PointErrors, Shares) {
  EXPECT_DOUBLE_EQ(shareWithin(kTruth, {0, 0, 0}, 1), 2.0 / 3);
  EXPECT_DOUBLE_EQ(shareUpTo({0.1, 0.2, 0.3, 0.4}, 0.3), 0.75);
  EXPECT_EQ(shareUpTo({}, 1), 0);
}

TEST(PointErrors, ALineThatIsNotThereIsRefused) {
  EXPECT_THROW(pointErrors({kTruth[0]}, {2}, kRecovered), std::out_of_range);
}

}  // namespace
}  // namespace sphc::host
