#include "runtime/stages/pose/kernels.h"

namespace sphc {

PoseF poseF(const Rigid &camera_from_map) {
  PoseF out;
  for (int i = 0; i < 3; ++i) {
    out.t[i] = static_cast<float>(camera_from_map.translation_m[i]);
    for (int j = 0; j < 3; ++j) out.r[3 * i + j] = static_cast<float>(camera_from_map.rotation(i, j));
  }
  return out;
}

Rigid rigidFrom(const PoseF &pose) {
  Rigid out;
  for (int i = 0; i < 3; ++i) {
    out.translation_m[i] = static_cast<double>(pose.t[i]);
    for (int j = 0; j < 3; ++j) out.rotation(i, j) = static_cast<double>(pose.r[3 * i + j]);
  }
  return out;
}

}  // namespace sphc
