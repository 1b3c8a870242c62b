#include "host/report/coverage.h"

#include <gtest/gtest.h>

#include <cmath>

#include "host/report/coverage_picture.h"

namespace sphc::host {
namespace {

using Directions = std::vector<std::array<double, 3>>;

// Everywhere, or without a cone of `hole_deg` around +x.
Directions spread(double hole_deg) {
  Directions directions;
  for (int pitch = -88; pitch <= 88; pitch += 4)
    for (int yaw = -178; yaw < 180; yaw += std::max(4, static_cast<int>(4 / std::cos(pitch * M_PI / 180)))) {
      const double y = yaw * M_PI / 180, p = pitch * M_PI / 180;
      const std::array<double, 3> d = {std::cos(p) * std::cos(y), std::cos(p) * std::sin(y), std::sin(p)};
      if (d[0] < std::cos(hole_deg * M_PI / 180)) directions.push_back(d);
    }
  return directions;
}

TEST(Coverage, AnEvenSpreadHasNoHole) {
  const Coverage coverage = coverageOf(spread(0), 5);
  EXPECT_GT(coverage.covered_share, 0.999);
  EXPECT_GT(coverage.evenness, 0.97);
  EXPECT_TRUE(coverage.holes.empty());
}

TEST(Coverage, AHoleIsFoundWithItsSize) {
  const Coverage coverage = coverageOf(spread(40), 5);
  ASSERT_EQ(coverage.holes.size(), 1u);  // not one in another
  EXPECT_NEAR(coverage.holes[0].yaw_deg, 0, 4);
  EXPECT_NEAR(coverage.holes[0].pitch_deg, 0, 4);
  EXPECT_NEAR(coverage.holes[0].radius_deg, 40, 5);
  const double hole = (1 - std::cos(36 * M_PI / 180)) / 2;  // what is more than 5 degrees inside, about
  EXPECT_NEAR(coverage.covered_share, 1 - hole, 0.02);
}

TEST(Coverage, OneDirectionIsTheLeastEven) {
  const Coverage coverage = coverageOf({{0, 0, 1}}, 3);
  EXPECT_NEAR(coverage.evenness, 1.0 / 200, 1e-9);
  ASSERT_FALSE(coverage.holes.empty());
  EXPECT_NEAR(coverage.holes[0].pitch_deg, -90, 3);
  EXPECT_NEAR(coverage.holes[0].radius_deg, 180, 3);
}

TEST(Coverage, NothingCoversNothing) {
  const Coverage coverage = coverageOf({}, 3);
  EXPECT_EQ(coverage.covered_share, 0);
  EXPECT_TRUE(coverage.holes.empty());
}

TEST(CoveragePicture, RingsAndCrossesChangeIt) {
  const Directions directions = spread(40);
  const cv::Mat plain = drawCoverage(directions, {}, {}),
                marked = drawCoverage(directions, coverageOf(directions, 1).holes, {{0, 1, 0}});
  EXPECT_GT(cv::norm(plain, marked, cv::NORM_L1), 0);
  // The cross: y is a quarter of the picture left of the middle.
  const cv::Rect there(marked.cols / 4 - 4, marked.rows / 2 - 4, 9, 9);
  EXPECT_GT(cv::norm(plain(there), marked(there), cv::NORM_L1), 0);
}

}  // namespace
}  // namespace sphc::host
