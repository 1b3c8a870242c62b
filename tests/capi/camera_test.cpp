#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/capi/bytes.h"
#include "tests/support/scene.h"

namespace {

using sphc::test::expectMentions;
using sphc::test::Output;

const double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(CInterfaceCamera, CheckExplains) {
  sphc_message message = {};
  sphc_camera camera = sphc::test::pinhole(640, 480, 500);
  EXPECT_EQ(sphc_camera_check(&camera, &message), SPHC_OK);
  EXPECT_EQ(sphc_camera_check(nullptr, &message), SPHC_E_ARGUMENT);
  expectMentions(message.text, "null");
  EXPECT_EQ(sphc_camera_check(nullptr, nullptr), SPHC_E_ARGUMENT);
  camera.params[2] = kNan;
  EXPECT_EQ(sphc_camera_check(&camera, &message), SPHC_E_ARGUMENT);
  expectMentions(message.text, "camera.params[2] is nan; a parameter must be finite");
}

TEST(CInterfaceCamera, ProjectAndBack) {
  const sphc_camera camera = sphc::test::pinhole(640, 480, 500);
  const double point[3] = {0.2, -0.1, 2};
  double pixel[2], bearing[3];
  ASSERT_EQ(sphc_camera_project(&camera, point, pixel), SPHC_OK);
  EXPECT_DOUBLE_EQ(pixel[0], 320 + 50);
  EXPECT_DOUBLE_EQ(pixel[1], 240 - 25);
  ASSERT_EQ(sphc_camera_unproject(&camera, pixel, bearing), SPHC_OK);
  const double norm = std::sqrt(0.04 + 0.01 + 4);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(bearing[i], point[i] / norm, 1e-12);
}

// Without distortion: what is so far off the axis has no pixel all the same.
TEST(CInterfaceCamera, BeyondItsFieldOfViewACameraHasNoPixels) {
  struct Field {
    sphc_camera_model model;
    uint32_t param_count;
    double widest_deg;
  };
  for (const Field &field : {Field{SPHC_CAMERA_PINHOLE, 4, 89}, Field{SPHC_CAMERA_KANNALA_BRANDT4, 8, 89},
                             Field{SPHC_CAMERA_BROWN5, 9, 83}, Field{SPHC_CAMERA_BROWN8, 12, 83}}) {
    sphc_camera camera = sphc::test::pinhole(640, 480, 500);
    camera.model = field.model;
    camera.param_count = field.param_count;
    for (const double off_deg : {-0.3, 0.3}) {
      const double angle_rad = (field.widest_deg + off_deg) * M_PI / 180;
      const double point[3] = {std::sin(angle_rad), 0, std::cos(angle_rad)};
      double pixel[2];
      EXPECT_EQ(sphc_camera_project(&camera, point, pixel), off_deg < 0 ? SPHC_OK : SPHC_OUTSIDE)
          << field.model << " at " << field.widest_deg + off_deg << " degrees";
    }
  }
}

// Their sum is not finite, and each of them is.
TEST(CInterfaceCamera, NumbersMayBeAsLargeAsThereAre) {
  const sphc_camera camera = sphc::test::pinhole(640, 480, 500);
  const double far[3] = {1e308, -5e307, 1e308}, aside[3] = {1e308, 1e308, 1}, far_pixel[2] = {1.7e308, 1.7e308};
  double pixel[2], bearing[3];
  ASSERT_EQ(sphc_camera_project(&camera, far, pixel), SPHC_OK);
  EXPECT_DOUBLE_EQ(pixel[0], 320 + 500);
  EXPECT_DOUBLE_EQ(pixel[1], 240 - 250);
  EXPECT_EQ(sphc_camera_project(&camera, aside, pixel), SPHC_OUTSIDE);
  EXPECT_EQ(sphc_camera_unproject(&camera, far_pixel, bearing), SPHC_OUTSIDE);
}

TEST(CInterfaceCamera, FailureLeavesOutputsUntouched) {
  const sphc_camera good = sphc::test::pinhole(640, 480, 500);
  sphc_camera bad = good;
  bad.param_count = 5;
  sphc_camera folded = good;  // distortion that no bearing brings so far out
  folded.model = SPHC_CAMERA_BROWN5;
  folded.param_count = 9;
  folded.params[4] = -0.4;
  const double far_pixel[2] = {5000, 5000};
  const double behind[3] = {0, 0, -1}, front[3] = {0, 0, 1}, nan_point[3] = {kNan, 0, 1};
  const double pixel[2] = {1, 1}, nan_pixel[2] = {kNan, 1};
  Output<double[2]> projected;
  Output<double[3]> bearing;
  EXPECT_EQ(sphc_camera_project(&good, behind, *projected.get()), SPHC_OUTSIDE);
  EXPECT_EQ(sphc_camera_project(&good, nan_point, *projected.get()), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_camera_project(&bad, front, *projected.get()), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_camera_project(nullptr, front, *projected.get()), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_camera_project(&good, nullptr, *projected.get()), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_camera_project(&good, front, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_camera_unproject(&folded, far_pixel, *bearing.get()), SPHC_OUTSIDE);
  EXPECT_EQ(sphc_camera_unproject(&good, nan_pixel, *bearing.get()), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_camera_unproject(&bad, pixel, *bearing.get()), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_camera_unproject(nullptr, pixel, *bearing.get()), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_camera_unproject(&good, nullptr, *bearing.get()), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_camera_unproject(&good, pixel, nullptr), SPHC_E_ARGUMENT);
  EXPECT_TRUE(projected.untouched());
  EXPECT_TRUE(bearing.untouched());
}

TEST(CInterfaceRigid, NullChangesNothing) {
  const sphc_rigid a = {{0.8, 0.6, 0, 0}, {1, 2, 3}};
  const double x[3] = {1, 2, 3};
  Output<sphc_rigid> rigid;
  Output<double[3]> moved;
  sphc_rigid_compose(nullptr, &a, rigid.get());
  sphc_rigid_compose(&a, nullptr, rigid.get());
  sphc_rigid_inverse(nullptr, rigid.get());
  sphc_rigid_apply(nullptr, x, *moved.get());
  sphc_rigid_apply(&a, nullptr, *moved.get());
  EXPECT_TRUE(rigid.untouched());
  EXPECT_TRUE(moved.untouched());
  sphc_rigid_compose(&a, &a, nullptr);
  sphc_rigid_inverse(&a, nullptr);
  sphc_rigid_apply(&a, x, nullptr);
}

// Whoever forgot to set a transform sees it in what follows from it.
TEST(CInterfaceRigid, WhatIsNotFiniteStaysSo) {
  const sphc_rigid good = {{0.8, 0.6, 0, 0}, {1, 2, 3}};
  const double x[3] = {1, 2, 3};
  for (const double number : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const sphc_rigid bad = {{0.8, number, 0, 0}, {1, 2, 3}};
    sphc_rigid composed, inverse;
    double moved[3];
    sphc_rigid_compose(&good, &bad, &composed);
    sphc_rigid_inverse(&bad, &inverse);
    sphc_rigid_apply(&bad, x, moved);
    EXPECT_TRUE(std::isnan(composed.q_wxyz[0]));
    EXPECT_TRUE(std::isnan(inverse.q_wxyz[0]));
    EXPECT_TRUE(std::isnan(moved[1]));
  }
}

TEST(CInterfaceRigid, QuaternionsOfAnyLengthAreNormalised) {
  const double x[3] = {1, 0, 0};
  for (const double length : {5e-324, 1e-310, 1e-170, 1e-3, 1e3, 1e160, 1e308}) {
    const sphc_rigid quarter_turn = {{length, 0, 0, length}, {0, 0, 0}};
    sphc_rigid half_turn;
    double moved[3];
    sphc_rigid_compose(&quarter_turn, &quarter_turn, &half_turn);
    sphc_rigid_apply(&quarter_turn, x, moved);
    EXPECT_NEAR(half_turn.q_wxyz[3], 1, 1e-12) << length;
    EXPECT_NEAR(moved[1], 1, 1e-12) << length;
  }
  const sphc_rigid zeros = {{0, 0, 0, 0}, {0, 0, 0}};
  double moved[3];
  sphc_rigid_apply(&zeros, x, moved);
  EXPECT_EQ(moved[0], 1);
}

TEST(CInterfaceRigid, OutputMayBeAnInput) {
  const sphc_rigid a = {{0.8, 0.6, 0, 0}, {1, 2, 3}}, b = {{0.6, 0, -0.8, 0}, {-1, 0.5, 2}};
  sphc_rigid ab, inverse, identity;
  sphc_rigid_compose(&a, &b, &ab);
  sphc_rigid left = a, right = b;
  sphc_rigid_compose(&left, &b, &left);
  sphc_rigid_compose(&a, &right, &right);
  sphc_rigid_inverse(&ab, &inverse);
  sphc_rigid_compose(&ab, &inverse, &identity);
  for (int i = 0; i < 4; ++i) {
    EXPECT_DOUBLE_EQ(left.q_wxyz[i], ab.q_wxyz[i]);
    EXPECT_DOUBLE_EQ(right.q_wxyz[i], ab.q_wxyz[i]);
    EXPECT_NEAR(identity.q_wxyz[i], i == 0, 1e-15);
  }
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(identity.t_m[i], 0, 1e-14);
  double x[3] = {0.3, -2, 1};
  double y[3];
  sphc_rigid_apply(&b, x, y);
  sphc_rigid_apply(&a, y, y);
  sphc_rigid_apply(&ab, x, x);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(x[i], y[i], 1e-14);
}

}  // namespace
