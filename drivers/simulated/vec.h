// vec.h - three-vectors, rotation matrices and rigid poses: the little linear algebra this driver needs.
#pragma once

#include <cmath>

#include "spherecloud/spherecloud.h"

namespace sphc::simulated {

constexpr double kPi = 3.14159265358979323846;
constexpr float kFloatPi = 3.14159265f;

template <class T>
struct Vec3 {
  T x{}, y{}, z{};
};
using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;

template <class T>
constexpr Vec3<T> operator+(const Vec3<T> &a, const Vec3<T> &b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
constexpr Vec3<T> operator-(const Vec3<T> &a, const Vec3<T> &b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
constexpr Vec3<T> operator*(const Vec3<T> &a, T s) {
  return {a.x * s, a.y * s, a.z * s};
}
template <class T>
constexpr T dot(const Vec3<T> &a, const Vec3<T> &b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
constexpr Vec3<T> cross(const Vec3<T> &a, const Vec3<T> &b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
T norm(const Vec3<T> &a) {
  return std::sqrt(dot(a, a));
}
template <class T>
Vec3<T> normalized(const Vec3<T> &a) {
  return a * (T(1) / norm(a));
}
inline Vec3f toFloat(const Vec3d &a) {
  return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}
inline Vec3d toDouble(const Vec3f &a) {
  return {static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z)};
}

// Row-major 3 x 3.
template <class T>
struct Mat3 {
  Vec3<T> row[3];
};
using Mat3f = Mat3<float>;
using Mat3d = Mat3<double>;
constexpr Mat3d kUpright{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

template <class T>
constexpr Vec3<T> operator*(const Mat3<T> &m, const Vec3<T> &v) {
  return {dot(m.row[0], v), dot(m.row[1], v), dot(m.row[2], v)};
}
template <class T>
constexpr Mat3<T> transposed(const Mat3<T> &m) {
  return {{{m.row[0].x, m.row[1].x, m.row[2].x},
           {m.row[0].y, m.row[1].y, m.row[2].y},
           {m.row[0].z, m.row[1].z, m.row[2].z}}};
}
template <class T>
constexpr Mat3<T> operator*(const Mat3<T> &a, const Mat3<T> &b) {
  const Mat3<T> bt = transposed(b);
  Mat3<T> out{};
  for (int i = 0; i < 3; ++i) {
    out.row[i] = {dot(a.row[i], bt.row[0]), dot(a.row[i], bt.row[1]), dot(a.row[i], bt.row[2])};
  }
  return out;
}
inline Mat3f toFloat(const Mat3d &m) { return {{toFloat(m.row[0]), toFloat(m.row[1]), toFloat(m.row[2])}}; }

// Rotation about the vertical by `yaw` radians: x turns towards y.
inline Mat3d yawRotation(double yaw) {
  const double c = std::cos(yaw);
  const double s = std::sin(yaw);
  return {{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}};
}

// world_from_camera: x_world = rotation x_camera + center.
struct Pose {
  Mat3d rotation{};
  Vec3d center{};
};

Mat3d matrixOf(const double q_wxyz[4]);
sphc_rigid rigidOf(const Pose &pose);
Pose poseOf(const sphc_rigid &rigid);
// a_from_c = a_from_b b_from_c.
Pose compose(const Pose &a_from_b, const Pose &b_from_c);

}  // namespace sphc::simulated
