#include "host/mapping/pose_block.h"

#include <algorithm>

namespace sphc::host {

PoseBlock blockFrom(const Rigid &pose) {
  PoseBlock block;
  quaternionFromRotation(pose.rotation, block.data());
  std::copy_n(pose.translation_m.data(), 3, block.data() + 4);
  return block;
}

Rigid poseFrom(const double *block) {
  return {rotationFromQuaternion(block), Vector3(block[4], block[5], block[6])};
}

bool PoseManifold::Plus(const double *x, const double *delta, double *x_plus_delta) const {
  const Rigid pose = poseFrom(x);
  const Matrix3 turn = rotationFromVector(Vector3(delta[0], delta[1], delta[2]));
  const Vector3 shift(delta[3], delta[4], delta[5]);
  const PoseBlock moved = blockFrom({turn * pose.rotation, turn * pose.translation_m + shift});
  std::copy(moved.begin(), moved.end(), x_plus_delta);
  return true;
}

bool PoseManifold::PlusJacobian(const double *, double *jacobian) const {
  std::fill_n(jacobian, 7 * 6, 0.0);
  for (int i = 0; i < 6; ++i) jacobian[i * 6 + i] = 1;
  return true;
}

bool PoseManifold::Minus(const double *y, const double *x, double *y_minus_x) const {
  const Rigid step = poseFrom(y) * poseFrom(x).inverse();
  const Vector3 turn = vectorFromRotation(step.rotation);
  std::copy_n(turn.data(), 3, y_minus_x);
  std::copy_n(step.translation_m.data(), 3, y_minus_x + 3);
  return true;
}

bool PoseManifold::MinusJacobian(const double *, double *jacobian) const {
  std::fill_n(jacobian, 6 * 7, 0.0);
  for (int i = 0; i < 6; ++i) jacobian[i * 7 + i] = 1;
  return true;
}

}  // namespace sphc::host
