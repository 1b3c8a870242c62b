// Rotations: quaternions from outside, matrices inside, rotation vectors for small steps.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>

#include "runtime/base/elementary.h"

#ifndef EIGEN_DONT_VECTORIZE
#error "Eigen's packets give every machine other last bits; a target links sphc_flags, which switches them off"
#endif

namespace sphc {

using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

inline Matrix3 crossMatrix(const Vector3 &v) {
  Matrix3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

// Rotation matrix of a quaternion (w, x, y, z), which need not have unit length; identity for zero.
Matrix3 rotationFromQuaternion(const double q_wxyz[4]);
// Unit quaternion with w >= 0 (Shepperd 1978: the largest component first).
void quaternionFromRotation(const Matrix3 &rotation, double q_wxyz[4]);
// exp of the cross matrix of a rotation vector, radians (Rodrigues).
Matrix3 rotationFromVector(const Vector3 &rotation_rad);
// Its inverse, of a rotation of less than half a turn.
Vector3 vectorFromRotation(const Matrix3 &rotation);
// Angle of a rotation, radians, in [0, pi].
double rotationAngle(const Matrix3 &rotation);
// Between two directions of any length, radians, in [0, pi]; 0 where one is zero.
double angleBetween(const Vector3 &a, const Vector3 &b);

}  // namespace sphc
