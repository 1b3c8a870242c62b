#include "runtime/stages/pose/focal_scale.h"

#include <Eigen/LU>
#include <algorithm>

#include "runtime/stages/pose/refine.h"
#include "runtime/stages/pose/residual.h"
#include "runtime/stages/pose/symmetric.h"

namespace sphc {
namespace {

constexpr uint32_t kFocalUnknowns = kPoseUnknowns + 1;  // those of a pose, and the scale
constexpr uint32_t kFocalGrain = 64;                    // correspondences between two looks at the clock
constexpr double kFocalGate = 64;                       // times scale2: residuals beyond it are not looked at
constexpr double kVagueFocal = 1e-6;                    // information about what nothing pins down
constexpr double kLeastFocalScale = -0.4, kMostFocalScale = 0.6;
// Squared residuals at which a match has lost three quarters of its weight, step by step: those that the stated
// focal length made outliers come back.
constexpr double kFocalScales2[] = {32, 16, 16, kFinalScale2, kFinalScale2, kFinalScale2};

struct FocalState {
  PoseState others;
  double off = 0;
  FocalDerivatives derivatives = FocalDerivatives::kAtFoot;
};

// Of the unknowns in the order of refinement: turn, shift, bias; and the scale apart.
struct FocalEquations {
  Matrix8 matrix = Matrix8::Zero();
  Vector8 shared = Vector8::Zero(), gradient = Vector8::Zero();
  double own = 0, own_gradient = 0;
};

// How the error of a match, and by what weight it counts, changes with the unknowns.
struct FocalRow {
  Eigen::Matrix<double, 3, kFocalUnknowns> jacobian;
  Vector3 whitened;
  double weight = 0;
};

bool rowOf(const Correspondence &given, const DepthCalibration &depth, const FocalState &at, double scale2,
           FocalRow *row) {
  const LiftedPoint &stated = given.lifted;
  if (!stated.hasDepth()) return false;
  const double z = stated.point_m.z(), beyond_m = z - depth.mid_m;
  const double longer = 1 + (depth.correctionAt(z) + at.others.bias[0] + at.others.bias[1] * beyond_m) / z;
  const bool is_scaled = stated.centre_m.isZero(0);

  Correspondence c = given;
  c.lifted.point_m = longer * stated.point_m;
  if (is_scaled) c.lifted.point_m.head<2>() *= 1 + at.off;
  const double stretched = c.lifted.point_m.norm() / stated.point_m.norm();
  c.lifted.sideways_m *= stretched;
  c.lifted.along_m *= stretched * depth.noise_scale;
  const Residual r = residualOf(c, at.others.pose);
  if (!r.in_front || !(r.squared < kFocalGate * scale2)) return false;

  const Vector3 &seen_m = at.derivatives == FocalDerivatives::kAtFoot ? r.foot_m : c.lifted.point_m;
  const Matrix3 across = acrossRay(c.lifted, r);
  const Vector3 longer_by_bias = across * seen_m / (longer * z);
  const Vector3 scaled = across * Vector3(seen_m.x(), seen_m.y(), 0) / (1 + at.off);
  row->jacobian << across * crossMatrix(r.foot_m), -across, longer_by_bias, beyond_m * longer_by_bias,
      is_scaled ? scaled : Vector3(Vector3::Zero());
  row->whitened = r.whitened;
  row->weight = finalInformation(r.squared * kFinalScale2 / scale2);
  return true;
}

void add(const FocalRow &row, FocalEquations *equations) {
  for (uint32_t i = 0; i < kFocalUnknowns; ++i) {
    const Vector3 column = row.weight * row.jacobian.col(i);
    const double pull = column.dot(row.whitened);
    if (i == kPoseUnknowns) {
      equations->own += column.dot(row.jacobian.col(i));
      equations->own_gradient += pull;
      continue;
    }
    equations->gradient[i] += pull;
    equations->shared[i] += column.dot(row.jacobian.col(kPoseUnknowns));
    for (uint32_t j = 0; j <= i; ++j) equations->matrix(i, j) += column.dot(row.jacobian.col(j));
  }
}

void addPrior(const DepthCalibration &depth, const FocalState &at, FocalEquations *equations) {
  equations->matrix.diagonal().array() += kVagueFocal;
  if (depth.isKnown()) {
    equations->matrix.bottomRows<2>().setZero();
    equations->matrix(6, 6) = equations->matrix(7, 7) = 1;
    equations->shared.tail<2>().setZero();
    equations->gradient.tail<2>().setZero();
    return;
  }
  const Matrix2 information = depth.covariance.inverse();
  equations->matrix.bottomRightCorner<2, 2>() += information;
  equations->gradient.tail<2>() += information * at.others.bias;
}

// False where the deadline passes before.
bool linearise(Span<const Correspondence> correspondences, const DepthCalibration &depth, const FocalState &at,
               double scale2, Watch *watch, FocalEquations *equations) {
  FocalRow row;
  for (const Correspondence &c : correspondences) {
    if (watch->passed(1)) return false;
    if (rowOf(c, depth, at, scale2, &row)) add(row, equations);
  }
  addPrior(depth, at, equations);
  return true;
}

// One step for all unknowns, the scale's by the Schur complement of the others.  False where nothing pins it down.
bool step(const FocalEquations &equations, FocalState *state, double *information) {
  const Vector8 by_scale = solveSymmetric(equations.matrix, equations.shared);
  const Vector8 by_others = solveSymmetric(equations.matrix, equations.gradient);
  *information = equations.own - equations.shared.dot(by_scale);
  const double pull = equations.own_gradient - equations.shared.dot(by_others);
  if (!(*information > kVagueFocal) || !isFinite(pull)) return false;
  const double off = std::min(std::max(state->off - pull / *information, kLeastFocalScale), kMostFocalScale);
  const Vector8 others = -by_others - (off - state->off) * by_scale;
  if (!isFinite(others.sum())) return false;
  state->others = moved(state->others, others);
  state->off = off;
  return true;
}

}  // namespace

FocalScale focalScaleOf(Span<const Correspondence> correspondences, const Estimate &estimate,
                        const DepthCalibration &depth, FocalDerivatives derivatives, double doubtful_sigmas,
                        const Deadline &deadline) {
  Watch watch(deadline, kFocalGrain);
  FocalState state = {{estimate.camera_from_map, estimate.depth.mean - depth.mean}, 0, derivatives};
  const double scatter = std::max(1.0, estimate.unit_variance);
  FocalScale found;
  const auto follow = [&](double scale2) {
    FocalEquations equations;
    double information;
    if (!linearise(correspondences, depth, state, scale2, &watch, &equations)) return false;
    if (!step(equations, &state, &information)) return false;
    found = {state.off, sqrtOf(scatter / information)};
    return true;
  };
  if (!follow(kFinalScale2)) return {};
  if (!found.isBeyond(doubtful_sigmas)) return found;
  for (const double scale2 : kFocalScales2)
    if (!follow(scale2)) return {};
  return found;
}

}  // namespace sphc
