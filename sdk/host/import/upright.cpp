#include "host/import/upright.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace sphc::host {
namespace {

constexpr double kUprightness = 0.1;  // heads nod much more than they tilt

}  // namespace

Vector3 downByCameras(const std::vector<Matrix3> &camera_from_world) {
  Matrix3 across = Matrix3::Zero();
  Vector3 down = Vector3::Zero();
  for (const Matrix3 &rotation : camera_from_world) {
    const Vector3 x = rotation.row(0), y = rotation.row(1);
    across += x * x.transpose() - kUprightness * y * y.transpose();
    down += y;
  }
  const Vector3 axis = Eigen::SelfAdjointEigenSolver<Matrix3>(across).eigenvectors().col(0);
  return axis.dot(down) < 0 ? Vector3(-axis) : axis;
}

Matrix3 uprightAxes(const Vector3 &down) {
  return Eigen::Quaterniond::FromTwoVectors(down, -Vector3::UnitZ()).toRotationMatrix();
}

}  // namespace sphc::host
