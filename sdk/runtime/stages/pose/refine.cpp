#include "runtime/stages/pose/refine.h"

#include "runtime/stages/pose/symmetric.h"

namespace sphc {
namespace {

constexpr double kGate = 64;  // times scale2: residuals beyond it are not looked at
// The weighted normal matrix is stiffer than the loss's curvature: E w over E div psi / 2, for Gaussian residuals
// at the scales in use (1.2 to 1.4).
constexpr double kLongerStep = 1.3;
// Covariance of the estimate over the inverse of the weighted normal matrix: E|psi|^2 E w / (2 (E div psi / 2)^2)
// at the final scale, 8, again for Gaussian residuals (Huber, "Robust Statistics", 1981, section 7.6).
constexpr double kCovarianceOfLoss = 0.80;
// Residuals of epipolar planes have one dimension: E psi^2 E w / (E psi')^2.
constexpr double kCovarianceOfPlaneLoss = 0.93;
constexpr double kLeastDamping = 1e-6;
constexpr uint32_t kRefineGrain = 2048,
                   kSolving = 256;   // rows between two looks at the clock; rows that a solution costs
constexpr double kConverged = 1e-3;  // of the squared step in units of its own standard deviation

struct NormalEquations {
  Matrix8 matrix = Matrix8::Zero();
  Vector8 gradient = Vector8::Zero();
  double cost = 0;

  void add(const NormalSums &sums) {
    uint32_t entry = 0;
    for (uint32_t i = 0; i < kPoseUnknowns; ++i) {
      gradient[i] += static_cast<double>(sums.gradient[i]);
      for (uint32_t j = i; j < kPoseUnknowns; ++j, ++entry) {
        matrix(i, j) += static_cast<double>(sums.matrix[entry]);
        if (j > i) matrix(j, i) = matrix(i, j);
      }
    }
    cost += static_cast<double>(sums.cost);
  }
};

// What is known beside the rows.  The vertical: (R up_map - up_camera) / sigma, and a turn by omega adds
// omega x R up_map.
NormalEquations priorEquations(const RefineTask &task, const PoseState &at) {
  NormalEquations equations;
  if (task.prior && task.prior->has_up) {
    const double weight = 1 / (task.prior->up_sigma_rad * task.prior->up_sigma_rad);
    const Vector3 up = at.pose.rotation * task.prior->up_map, error = up - task.prior->up_camera;
    const Matrix3 jacobian = -crossMatrix(up);
    equations.matrix.topLeftCorner<3, 3>() = weight * jacobian.transpose() * jacobian;
    equations.gradient.head<3>() = weight * jacobian.transpose() * error;
    equations.cost = weight * error.squaredNorm();
  }
  if (task.depth.isKnown()) {
    equations.matrix(6, 6) = equations.matrix(7, 7) = 1;  // held at zero
  } else {
    const Matrix2 information = task.depth.covariance.inverse();
    equations.matrix.bottomRightCorner<2, 2>() = information;
    equations.gradient.tail<2>() = information * at.bias;
    equations.cost += at.bias.dot(information * at.bias);
  }
  return equations;
}

NormalEquations planeEquations(const RefineTask &task, const NormalTask &kernel) {
  NormalEquations equations;
  if (!task.planes || task.planes->count == 0) return equations;
  NormalSums sums;
  task.kernels->plane_equations(*task.planes, kernel, &sums);
  equations.add(sums);
  return equations;
}

NormalEquations linearise(const RefineTask &task, const PoseState &at) {
  const NormalTask kernel = normalTask(task, at.pose, at.bias);
  NormalEquations equations = priorEquations(task, at);
  NormalSums sums;
  task.kernels->lifted_equations(*task.lifted, kernel, &sums);
  equations.add(sums);
  const NormalEquations planes = planeEquations(task, kernel);
  equations.matrix += planes.matrix;
  equations.gradient += planes.gradient;
  equations.cost += planes.cost;
  return equations;
}

// Of the state at which everything together has the normal matrix `all`.
Matrix8 informationAt(const RefineTask &task, const PoseState &at, const Matrix8 &all) {
  const Matrix8 prior = priorEquations(task, at).matrix;
  const Matrix8 planes = planeEquations(task, normalTask(task, at.pose, at.bias)).matrix;
  return prior + (all - prior - planes) / kCovarianceOfLoss + planes / kCovarianceOfPlaneLoss;
}

Vector8 solved(const NormalEquations &equations, double damping) {
  Matrix8 damped = equations.matrix;
  damped.diagonal() *= 1 + damping;
  damped.diagonal().array() += 1e-9;
  return -kLongerStep * solveSymmetric(damped, equations.gradient);
}

// The Newton decrement: step^T H step.
bool isSmall(const Vector8 &step, const NormalEquations &equations) {
  return -step.dot(equations.gradient) < kConverged;
}

}  // namespace

PoseState moved(const PoseState &state, const Vector8 &step) {
  const Matrix3 turn = rotationFromVector(step.head<3>());
  PoseState next;
  next.pose = {turn * state.pose.rotation, turn * state.pose.translation_m + step.segment<3>(3)};
  next.bias = state.bias + step.tail<2>();
  return next;
}

NormalTask normalTask(const RefineTask &task, const Rigid &pose, const Vector2 &bias) {
  NormalTask kernel = {};
  kernel.pose = poseF(pose);
  kernel.with_bias = !task.depth.isKnown();
  kernel.correction = {static_cast<float>(bias[0]), static_cast<float>(bias[1]),
                       static_cast<float>(task.depth.mid_m), 1.0f};
  kernel.inverse_scale2 = static_cast<float>(1 / task.scale2);
  kernel.gate2 = static_cast<float>(kGate * task.scale2);
  return kernel;
}

double finalInformation(double squared) {
  const double weight = 1 / (1 + squared / kFinalScale2);
  return weight * weight / kCovarianceOfLoss;
}

Rigid improvePose(const RefineTask &task, const Rigid &start, int steps) {
  RefineTask plain = task;
  plain.depth.covariance.setZero();
  PoseState state;
  state.pose = start;
  for (int i = 0; i < steps; ++i) {
    const NormalEquations now = linearise(plain, state);
    const Vector8 step = solved(now, kLeastDamping);
    if (!isFinite(step.sum())) break;
    state = moved(state, step);
    if (isSmall(step, now)) break;
  }
  return state.pose;
}

Refinement refinePose(const RefineTask &task, const Rigid &start, int iterations) {
  PoseState state;
  state.pose = start;
  NormalEquations now = linearise(task, state);
  double damping = kLeastDamping;
  Watch watch(task.deadline, kRefineGrain);
  for (int i = 0; i < iterations; ++i) {
    if (watch.passed(task.lifted->count + kSolving)) break;
    const Vector8 step = solved(now, damping);
    if (!isFinite(step.sum())) break;
    const PoseState next = moved(state, step);
    if (isSmall(step, now)) {  // too small to be worth another step
      state = next;
      break;
    }
    const NormalEquations there = linearise(task, next);
    if (there.cost < now.cost) {
      state = next;
      now = there;
      damping *= 0.1;
    } else {
      damping = damping * 100 + 1e-3;
    }
  }
  return {state.pose, state.bias, informationAt(task, state, now.matrix), now.cost};
}

}  // namespace sphc
