#include "host/report/above.h"

#include <gtest/gtest.h>

#include "frames.h"

namespace sphc::host {
namespace {

// A camera that looks along world x with world z up: camera y is world -z.
sphc_rigid upright(double x, double y) { return {{0.5, -0.5, 0.5, -0.5}, {x, y, 1}}; }

TEST(ViewFromAbove, FindsTheHorizontalPlaneAndTheLongestWay) {
  std::vector<sphc_rigid> poses;
  for (int i = 0; i < 10; ++i) poses.push_back(upright(0.1 * (i % 2), i));
  const AboveView view = viewFromAbove(poses);
  EXPECT_NEAR(std::abs(view.right[1]), 1, 0.05);
  EXPECT_NEAR(view.right[2], 0, 1e-9);
  EXPECT_NEAR(view.up[2], 0, 1e-9);
}

TEST(ViewFromAbove, IsNotMirrored) {
  const AboveView view = viewFromAbove({upright(0, 0), upright(1, 0)});
  // right x up must point to the sky.
  EXPECT_NEAR(view.right[0] * view.up[1] - view.right[1] * view.up[0], 1, 1e-9);
}

TEST(ViewFromAbove, OfNoPoseIsStillAView) {
  const AboveView view = viewFromAbove({});
  const double point[3] = {1, 2, 3};
  EXPECT_DOUBLE_EQ(view.project(point)[0], 1);
  EXPECT_DOUBLE_EQ(view.project(point)[1], 2);
}

}  // namespace
}  // namespace sphc::host
