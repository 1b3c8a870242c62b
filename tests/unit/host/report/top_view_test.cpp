#include "host/report/top_view.h"

#include <gtest/gtest.h>

#include "frames.h"

namespace sphc::host {
namespace {

// A camera that looks along world x with world z up: camera y is world -z.
sphc_rigid upright(double x, double y) { return {{0.5, -0.5, 0.5, -0.5}, {x, y, 1}}; }

double cosineOfUp(const TopView &view, const std::array<double, 3> &up) {
  const auto &r = view.right, &u = view.up;
  return up[0] * (r[1] * u[2] - r[2] * u[1]) + up[1] * (r[2] * u[0] - r[0] * u[2]) +
         up[2] * (r[0] * u[1] - r[1] * u[0]);
}

std::vector<sphc_rigid> wayAlongY() {
  std::vector<sphc_rigid> poses;
  for (int i = 0; i < 10; ++i) poses.push_back(upright(0.1 * (i % 2), i));
  return poses;
}

// Places on the picture are those of the trajectory.
TEST(TopView, OfAWorldWithAnAxisUpKeepsItsAxes) {
  const TopView view = topView(wayAlongY());
  EXPECT_EQ(view.right, (std::array<double, 3>{1, 0, 0}));
  EXPECT_EQ(view.up, (std::array<double, 3>{0, 1, 0}));
}

TEST(TopView, ElseFindsTheHorizontalPlaneAndTheLongestWay) {
  std::vector<sphc_rigid> poses = wayAlongY();
  const sphc_rigid tilt = {{std::cos(M_PI / 8), 0, std::sin(M_PI / 8), 0}, {0, 0, 0}};  // by 45 degrees about y
  for (sphc_rigid &pose : poses) sphc_rigid_compose(&tilt, &pose, &pose);
  const TopView view = topView(poses);
  EXPECT_FALSE(view.is_up_an_axis);
  EXPECT_NEAR(std::abs(view.right[1]), 1, 0.05);
  EXPECT_NEAR(cosineOfUp(view, {std::sqrt(0.5), 0, std::sqrt(0.5)}), 1, 1e-9);
}

// A camera turned about its x axis, in a world that the first camera made: 0 is level, with up -y.
sphc_rigid pitched(double deg) {
  const double half = deg * M_PI / 360;
  return {{std::cos(half), std::sin(half), 0, 0}, {0, 0, 0}};
}

// That the first camera looked down by 15 degrees does not put up where it held its top.
TEST(TopView, InAWorldOfTheFirstCameraGoesByTheMean) {
  const TopView tilted = topView({pitched(12), pitched(18)});
  EXPECT_FALSE(tilted.is_up_an_axis);
  EXPECT_NEAR(cosineOfUp(tilted, {0, -std::cos(15 * M_PI / 180), -std::sin(15 * M_PI / 180)}), 1, 1e-9);
  const TopView level = topView({pitched(2), pitched(4)});
  EXPECT_TRUE(level.is_up_an_axis);
  EXPECT_NEAR(cosineOfUp(level, {0, -1, 0}), 1, 1e-9);
  const TopView y_up = topView({pitched(195)});
  EXPECT_TRUE(y_up.is_up_an_axis);
  EXPECT_NEAR(cosineOfUp(y_up, {0, 1, 0}), 1, 1e-9);
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
