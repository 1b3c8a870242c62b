#include "runtime/stages/pose/score.h"

namespace sphc {

void PoseScorer::layout(uint32_t capacity, Arena &scratch, PoseScorer *scorer) {
  const uint32_t padded = (capacity + kBlock - 1) / kBlock * kBlock;
  for (int row = 0; row < kRowCount; ++row) {
    const Span<float> span = scratch.take<float>("pose.score", padded);
    if (scorer) scorer->rows_[row] = span;
  }
}

void PoseScorer::load(Span<const Correspondence> correspondences) {
  const uint32_t n = static_cast<uint32_t>(correspondences.size());
  count_ = (n + kBlock - 1) / kBlock * kBlock;
  for (uint32_t i = 0; i < n; ++i) {
    const LiftedPoint &lifted = correspondences[i].lifted;
    const Vector3 view = lifted.point_m.normalized();
    const double ratio = lifted.sideways_m / lifted.along_m;
    for (int k = 0; k < 3; ++k) {
      rows_[kPx + k][i] = static_cast<float>(lifted.point_m[k]);
      rows_[kVx + k][i] = static_cast<float>(view[k]);
      rows_[kDx + k][i] = static_cast<float>(correspondences[i].direction[k]);
    }
    rows_[kWeight][i] = static_cast<float>(1 / (lifted.sideways_m * lifted.sideways_m));
    rows_[kStretch][i] = static_cast<float>(ratio * ratio - 1);
  }
  for (int row = 0; row < kRowCount; ++row)  // padding: weight 0 and never behind, so that it costs nothing
    for (uint32_t i = n; i < count_; ++i) rows_[row][i] = row == kPz || row == kVz || row == kDz ? 1.0f : 0.0f;
}

float PoseScorer::score(const Rigid &camera_from_map, float truncation, float bound) const {
  float r[9], t[3];
  for (int i = 0; i < 3; ++i) {
    t[i] = static_cast<float>(camera_from_map.translation_m[i]);
    for (int j = 0; j < 3; ++j) r[3 * i + j] = static_cast<float>(camera_from_map.rotation(i, j));
  }
  const float *px = rows_[kPx].data(), *py = rows_[kPy].data(), *pz = rows_[kPz].data();
  const float *vx = rows_[kVx].data(), *vy = rows_[kVy].data(), *vz = rows_[kVz].data();
  const float *dx = rows_[kDx].data(), *dy = rows_[kDy].data(), *dz = rows_[kDz].data();
  const float *weight = rows_[kWeight].data(), *stretch = rows_[kStretch].data();
  float total = 0.0f;
  for (uint32_t block = 0; block < count_; block += kBlock) {
    float sum[kLanes] = {};
    for (uint32_t at = block; at < block + kBlock; at += kLanes) {
      for (uint32_t lane = 0; lane < kLanes; ++lane) {
        const uint32_t i = at + lane;
        const float nx = r[0] * dx[i] + r[1] * dy[i] + r[2] * dz[i];
        const float ny = r[3] * dx[i] + r[4] * dy[i] + r[5] * dz[i];
        const float nz = r[6] * dx[i] + r[7] * dy[i] + r[8] * dz[i];
        const float ex = px[i] - t[0], ey = py[i] - t[1], ez = pz[i] - t[2];
        // In the metric W^2 / sideways^-2 = I + stretch v v^T; see residual.h.
        const float vn = vx[i] * nx + vy[i] * ny + vz[i] * nz, ve = vx[i] * ex + vy[i] * ey + vz[i] * ez;
        const float en = ex * nx + ey * ny + ez * nz + stretch[i] * ve * vn;
        const float m = en / (1.0f + stretch[i] * vn * vn);
        const float qx = ex - m * nx, qy = ey - m * ny, qz = ez - m * nz, vq = ve - m * vn;
        const float squared = weight[i] * (qx * qx + qy * qy + qz * qz + stretch[i] * vq * vq);
        const float cost = squared < truncation ? squared : truncation;
        sum[lane] += en > 0.0f || weight[i] == 0.0f ? cost : truncation;
      }
    }
    total += ((sum[0] + sum[4]) + (sum[1] + sum[5])) + ((sum[2] + sum[6]) + (sum[3] + sum[7]));
    if (total >= bound) return total;
  }
  return total;
}

}  // namespace sphc
