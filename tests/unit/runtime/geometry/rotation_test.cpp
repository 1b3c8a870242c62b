#include "runtime/geometry/rotation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

TEST(Rotation, QuaternionAndMatrixRoundTrip) {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const Matrix3 rotation = test::randomRotation(&random);
    EXPECT_NEAR(rotation.determinant(), 1, 1e-12);
    EXPECT_LT((rotation * rotation.transpose() - Matrix3::Identity()).norm(), 1e-12);
    double q[4];
    quaternionFromRotation(rotation, q);
    EXPECT_GE(q[0], 0);
    EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1, 1e-14);
    EXPECT_LT((rotationFromQuaternion(q) - rotation).norm(), 1e-13);
  }
}

TEST(Rotation, HalfTurnsHaveQuaternionsToo) {  // where the real part vanishes
  const double axes[][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.6, 0.8, 0}, {0, -0.6, 0.8}, {-0.48, 0.6, 0.64}};
  for (const auto &a : axes) {
    const double q[4] = {0, a[0], a[1], a[2]};
    const Matrix3 rotation = rotationFromQuaternion(q);
    double back[4];
    quaternionFromRotation(rotation, back);
    EXPECT_LT((rotationFromQuaternion(back) - rotation).norm(), 1e-13);
    EXPECT_NEAR(rotationAngle(rotation), kPi, 1e-12);
  }
}

TEST(Rotation, QuaternionLengthDoesNotMatter) {
  const double q[4] = {1, 2, 3, 4}, longer[4] = {10, 20, 30, 40}, zero[4] = {};
  EXPECT_LT((rotationFromQuaternion(q) - rotationFromQuaternion(longer)).norm(), 1e-15);
  EXPECT_EQ(rotationFromQuaternion(zero), Matrix3::Identity());
}

TEST(Rotation, VectorIsAxisTimesAngle) {
  Random random(2);
  for (int i = 0; i < 5000; ++i) {
    const Vector3 axis = test::randomDirection(&random);
    const double angle = i % 4 ? test::uniformIn(&random, 0, 3.14) : std::pow(10, test::uniformIn(&random, -12, 0));
    const Matrix3 expected = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    const Matrix3 rotation = rotationFromVector(angle * axis);
    EXPECT_LT((rotation - expected).norm(), 1e-14);
    EXPECT_NEAR(rotationAngle(rotation), angle, 1e-9 * angle + 1e-15);
    EXPECT_LT((vectorFromRotation(rotation) - angle * axis).norm(), 1e-9 * angle + 1e-15);
  }
  EXPECT_EQ(rotationFromVector(Vector3::Zero()), Matrix3::Identity());
}

TEST(Rotation, AngleBetweenDirections) {
  Random random(3);
  for (int i = 0; i < 5000; ++i) {
    const Vector3 a = test::randomDirection(&random);
    const Vector3 axis = a.cross(test::randomDirection(&random)).normalized();
    const double angle = i % 4 ? test::uniformIn(&random, 0, kPi) : std::pow(10, test::uniformIn(&random, -12, 0));
    const Vector3 b = 3 * (Eigen::AngleAxisd(angle, axis) * a);
    EXPECT_NEAR(angleBetween(0.1 * a, b), angle, 1e-15 + 1e-9 * angle);
  }
  EXPECT_EQ(angleBetween(Vector3(1, 0, 0), Vector3(-2, 0, 0)), kPi);
  EXPECT_EQ(angleBetween(Vector3(1, 0, 0), Vector3::Zero()), 0);
}

TEST(Rotation, CrossMatrix) {
  const Vector3 a(1, 2, 3), b(-4, 5, 0.5);
  EXPECT_LT((crossMatrix(a) * b - a.cross(b)).norm(), 1e-15);
}

}  // namespace
}  // namespace sphc
