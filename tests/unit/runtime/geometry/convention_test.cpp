#include "runtime/geometry/convention.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

constexpr sphc_convention kFirst = SPHC_CONVENTION_OPENXR, kLast = SPHC_CONVENTION_TUM;

Matrix3 matrixOf(const int8_t axes[3]) {
  Matrix3 matrix = Matrix3::Zero();
  for (int i = 0; i < 3; ++i) matrix(i, std::abs(axes[i]) - 1) = axes[i] > 0 ? 1 : -1;
  return matrix;
}

Vector3 upOf(const Convention &convention) {
  Vector3 up = Vector3::Zero();
  up[std::abs(convention.up) - 1] = convention.up > 0 ? 1 : -1;
  return up;
}

TEST(Convention, TheTableIsOneOfFrames) {
  for (sphc_convention c = kFirst; c <= kLast; ++c) {
    const Convention *convention = conventionOf(c);
    ASSERT_NE(convention, nullptr);
    const double camera = matrixOf(convention->camera_axes).determinant();
    const double world = matrixOf(convention->world_axes).determinant();
    EXPECT_EQ(camera, world) << "a mirrored camera in a world that is not, or the other way round: " << c;
    EXPECT_EQ(world, c == SPHC_CONVENTION_UNITY ? -1 : 1);
  }
  EXPECT_EQ(conventionOf(kFirst - 1), nullptr);
  EXPECT_EQ(conventionOf(kLast + 1), nullptr);
}

TEST(Convention, WorldIsLevelAndProper) {
  Random random(1);
  for (sphc_convention c = kFirst; c <= kLast; ++c)
    for (int i = 0; i < 2000; ++i) {
      const Vector3 up_map = 9.81 * test::randomDirection(&random);
      const Rigid world_from_map = makeWorld(*conventionOf(c), up_map);
      EXPECT_LT((world_from_map.rotation * up_map.normalized() - upOf(*conventionOf(c))).norm(), 1e-14);
      EXPECT_NEAR(world_from_map.rotation.determinant(), 1, 1e-14);
      EXPECT_EQ(world_from_map.translation_m, Vector3::Zero());
    }
}

TEST(Convention, ALevelMapStaysAsItIs) {
  for (sphc_convention c = kFirst; c <= kLast; ++c)
    for (const double length : {1.0, 9.81, 1e-300, 1e300, std::numeric_limits<double>::denorm_min()}) {
      const Rigid world_from_map = makeWorld(*conventionOf(c), length * upOf(*conventionOf(c)));
      EXPECT_EQ(world_from_map.rotation, Matrix3::Identity()) << c << " " << length;
    }
}

// x stays level and where it is as long as up turns about it: maps with z up, y up, y down and z down.
TEST(Convention, XIsKeptWhereItIsLevel) {
  for (sphc_convention c = kFirst; c <= kLast; ++c)
    for (int degrees = 0; degrees <= 360; degrees += 15) {
      double sine, cosine;
      sinCos(degrees * kPi / 180, &sine, &cosine);
      const Rigid world_from_map = makeWorld(*conventionOf(c), {0, sine, cosine});
      EXPECT_LT((world_from_map.rotation * Vector3::UnitX() - Vector3::UnitX()).norm(), 1e-14) << degrees;
    }
}

TEST(Convention, HeadingIsSmooth) {  // a step of up moves the world by about as much, but near -z
  Random random(2);
  for (int i = 0; i < 5000; ++i) {
    const Vector3 up_map = test::randomDirection(&random), step = 1e-6 * test::randomDirection(&random);
    if (up_map.z() < -0.9) continue;
    const Convention &convention = *conventionOf(SPHC_CONVENTION_OPENXR);
    const Matrix3 one = makeWorld(convention, up_map).rotation,
                  other = makeWorld(convention, up_map + step).rotation;
    EXPECT_LT(rotationAngle(one.transpose() * other), 1e-5);
  }
}

TEST(Convention, NearlyMinusZIsExactToo) {
  for (const double off : {1e-3, 1e-8, 1e-12, 1e-160, 1e-200, 0.0}) {
    const Rigid world_from_map = makeWorld(*conventionOf(SPHC_CONVENTION_ROS_FLU), {off, -2 * off, -1});
    const Vector3 up = Vector3(off, -2 * off, -1).normalized();
    EXPECT_LT((world_from_map.rotation * up - Vector3::UnitZ()).norm(), 1e-14) << off;
    EXPECT_NEAR(world_from_map.rotation.determinant(), 1, 1e-14);
  }
}

TEST(Convention, AHalfTurnHasOneSign) {  // whatever the last digits are
  Random random(4);
  const Vector3 axes[] = {{0.6, 0, -0.8}, {-0.6, 0, 0.8}, {0, 0.6, -0.8}, {0, -0.6, 0.8}, {0, 0, 1}, {0, 0, -1}};
  for (int i = 0; i < 6000; ++i) {
    const Vector3 axis = axes[i % 6], noise = 1e-15 * test::normalVector(&random);
    const double q_wxyz[4] = {1e-15 * test::normal(&random), axis.x() + noise.x(), axis.y() + noise.y(),
                              axis.z() + noise.z()};
    const sphc_rigid numbers = numbersOf({rotationFromQuaternion(q_wxyz), Vector3::Zero()});
    const double sign = i % 2 ? -1 : 1;
    EXPECT_GE(numbers.q_wxyz[0], 0);
    EXPECT_LE(numbers.q_wxyz[0], 1e-13);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(numbers.q_wxyz[k + 1], sign * axis[k], 1e-13);
  }
}

TEST(Convention, WhatIsWrittenIsReadAgain) {
  Random random(3);
  for (sphc_convention c = kFirst; c <= kLast; ++c)
    for (int i = 0; i < 2000; ++i) {
      const Convention &convention = *conventionOf(c);
      const Rigid rigid = {test::randomRotation(&random), 3 * test::normalVector(&random)};
      double pose[7];
      writeCamera(convention, rigid, pose);
      const Rigid camera = readCamera(convention, reorder(convention, pose));
      EXPECT_LT((camera.rotation - rigid.rotation).norm(), 1e-14);
      EXPECT_LT((camera.translation_m - rigid.translation_m).norm(), 1e-14);
      writeMap(convention, rigid, pose);
      const Rigid map = readMap(convention, reorder(convention, pose));
      EXPECT_LT((map.rotation - rigid.rotation).norm(), 1e-14);
      EXPECT_LT((map.translation_m - rigid.translation_m).norm(), 1e-14);
    }
}

}  // namespace
}  // namespace sphc
