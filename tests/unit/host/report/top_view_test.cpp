#include "host/report/top_view.h"

#include <gtest/gtest.h>

#include "frames.h"

namespace sphc::host {
namespace {

// A camera that looks along world x with world z up: camera y is world -z.
sphc_rigid upright(double x, double y) { return {{0.5, -0.5, 0.5, -0.5}, {x, y, 1}}; }

TEST(TopView, FindsTheHorizontalPlaneAndTheLongestWay) {
  std::vector<sphc_rigid> poses;
  for (int i = 0; i < 10; ++i) poses.push_back(upright(0.1 * (i % 2), i));
  const TopView view = topView(poses);
  EXPECT_NEAR(std::abs(view.right[1]), 1, 0.05);
  EXPECT_NEAR(view.right[2], 0, 1e-9);
  EXPECT_NEAR(view.up[2], 0, 1e-9);
}

TEST(TopView, IsNotMirrored) {
  const TopView view = topView({upright(0, 0), upright(1, 0)});
  // right x up must point to the sky.
  EXPECT_NEAR(view.right[0] * view.up[1] - view.right[1] * view.up[0], 1, 1e-9);
}

TEST(TopView, OfNoPoseIsStillAView) {
  const TopView view = topView({});
  const double point[3] = {1, 2, 3};
  EXPECT_DOUBLE_EQ(view.project(point)[0], 1);
  EXPECT_DOUBLE_EQ(view.project(point)[1], 2);
}

}  // namespace
}  // namespace sphc::host
