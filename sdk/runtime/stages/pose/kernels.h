// The inner loops of the pose stage.  Two sets of the same code: Highway's best for this machine, and one compiled
// for single lanes.  No multiply-add, exact roots and divisions, and a fixed order of summation:
// every instruction set gives the same bits.
#pragma once
#include "runtime/geometry/rigid.h"
#include "runtime/stages/pose/rows.h"

namespace sphc {

// camera_from_map in single precision.
struct PoseF {
  float r[9];  // row-major
  float t[3];  // m
};
PoseF poseF(const Rigid &camera_from_map);
Rigid rigidFrom(const PoseF &camera_from_map);

// When a pose under scoring may be given up.
struct Score {
  float gain;  // sum over rows of max(0, 1 - residual^2 / threshold^2)
  float seen;  // rows looked at: all, unless given up
};
struct ScoreLimits {
  float inverse_threshold2;  // of the squared residual
  float best;                // a gain that cannot exceed this is of no interest
  float slope, offset;       // give up below slope * rows - offset: Wald's sequential test
};

constexpr uint32_t kMinimalBatch = kPoseLanes;  // minimal samples solved at once
constexpr uint32_t kMaxSolutions = 4;           // of each

// Minimal samples, side by side.
struct MinimalBatch {
  alignas(64) float point_m[3][3][kMinimalBatch];    // [which][axis]: camera frame
  alignas(64) float direction[3][3][kMinimalBatch];  // [which][axis]: map frame, unit
};
struct PoseBatch {
  alignas(64) float r[kMaxSolutions][9][kMinimalBatch];
  alignas(64) float t[kMaxSolutions][3][kMinimalBatch];
  alignas(64) float valid[kMaxSolutions][kMinimalBatch];  // 1 or 0

  PoseF pose(uint32_t solution, uint32_t sample) const {
    PoseF out;
    for (int i = 0; i < 9; ++i) out.r[i] = r[solution][i][sample];
    for (int i = 0; i < 3; ++i) out.t[i] = t[solution][i][sample];
    return out;
  }
};

// Rotations that take `up_map` to z and `up_camera` to z, for the upright solver.
struct UprightFrames {
  float upright_from_map[9], upright_from_camera[9];
};

// z grows by offset + slope (z - mid), its stated error by noise_scale.
struct DepthCorrection {
  float offset_m, slope, mid_m, noise_scale;
};

// Unknowns of the refinement: rotation (3), translation (3), depth offset, depth slope.
constexpr uint32_t kPoseUnknowns = 8;
constexpr float kNeverNear = 1e30f;
constexpr uint32_t kNormalEntries = kPoseUnknowns * (kPoseUnknowns + 1) / 2;
struct NormalTask {
  PoseF pose;
  DepthCorrection correction;
  float inverse_scale2;  // of the Geman-McClure loss
  float gate2;           // squared residuals beyond it count as that and pull no more
  bool with_bias;        // else its entries stay zero
};
struct NormalSums {
  float matrix[kNormalEntries];  // upper triangle by rows: J^T W J
  float gradient[kPoseUnknowns];
  float cost;
};

struct PoseKernels {
  // Makes view, weight and stretch of padded rows as they were pushed; lengthens the points by the correction.
  void (*prepare)(PoseRows *, const DepthCorrection &);
  Score (*score)(const PoseRows &, const PoseF &, const ScoreLimits &);
  // Of every row, padding too: residual^2 with the task's pose and bias, and that of its epipolar plane alone
  // (kNeverNear where it is behind the camera).
  void (*residuals)(const PoseRows &, const NormalTask &, float *squared);
  void (*plane_residuals)(const PoseRows &, const NormalTask &, float *squared);
  // Perspective-three-point of each sample; see p3p.h for the reference in double precision.
  void (*solve_p3p)(const MinimalBatch &, PoseBatch *);
  // Two points and a known vertical; the third of each sample is not looked at.
  void (*solve_upright)(const MinimalBatch &, const UprightFrames &, PoseBatch *);
  // Normal equations of lifted rows, and of rows without depth (their epipolar planes).
  void (*lifted_equations)(const PoseRows &, const NormalTask &, NormalSums *);
  void (*plane_equations)(const PoseRows &, const NormalTask &, NormalSums *);
};
const PoseKernels &simdPoseKernels();
const PoseKernels &scalarPoseKernels();

}  // namespace sphc
