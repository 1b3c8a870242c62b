#include "lab/baselines/paper_estimator.h"

#include <Eigen/Cholesky>

#include "lab/baselines/pose_step.h"
#include "runtime/base/random.h"
#include "runtime/stages/pose/p3p.h"

namespace sphc::host {
namespace {

constexpr uint32_t kSampleSize = 3;
constexpr int kLocalIterations = 25, kFinalIterations = 100;

// What the residual is made of.  x: the keypoint at depth 1; n: the map direction in the camera frame.
struct Parts {
  Vector3 x, n, line;    // line = t cross n: the epipolar line
  double across, norm2;  // x . line, and |line|^2 of its first two coordinates
  double scale;          // beta = line.y / scale
};

Parts partsOf(const Correspondence &c, const Rigid &pose) {
  Parts p;
  const Vector3 &point = c.lifted.point_m;
  p.x = point / point.z();
  p.n = pose.rotation * c.direction;
  p.line = pose.translation_m.cross(p.n);
  p.across = p.x.dot(p.line);
  p.norm2 = p.line.x() * p.line.x() + p.line.y() * p.line.y();
  p.scale = p.n.x() * point.z() - p.n.z() * point.x();
  return p;
}

// beta (px, pz) = alpha (nx, nz) + (tx, tz), solved for both.
PaperResidual residualFrom(const Parts &p, const Vector3 &point_m, const Vector3 &translation_m) {
  PaperResidual r;
  r.epipolar2 = p.across * p.across / p.norm2;
  r.beta = p.line.y() / p.scale;
  const double alpha = (point_m.x() * translation_m.z() - point_m.z() * translation_m.x()) / p.scale;
  r.in_front = r.beta > 0 && alpha > 0;
  return r;
}

double square(double x) { return x * x; }

double epipolarGate2(const PaperCostConfig &config) { return square(config.epipolar_gate_px / config.focal_px); }
double totalGate(const PaperCostConfig &config) {
  return epipolarGate2(config) + config.lambda * square(config.depth_gate);
}

// ---- refinement ----

struct Normal {
  Matrix6 matrix = Matrix6::Zero();
  Vector6 gradient = Vector6::Zero();
  double cost = 0;
};

// Derivative of g . n and g . line for a pose moved by (omega, tau): rotation exp(omega) R, translation t + tau.
Vector6 gradientOfDirection(const Parts &p, const Vector3 &g) {
  Vector6 d;
  d << p.n.cross(g), 0, 0, 0;
  return d;
}
Vector6 gradientOfLine(const Parts &p, const Vector3 &translation_m, const Vector3 &g) {
  Vector6 d;
  d << p.n.cross(g.cross(translation_m)), p.n.cross(g);
  return d;
}

void add(double residual, const Vector6 &jacobian, Normal *sum) {
  sum->matrix.noalias() += jacobian * jacobian.transpose();
  sum->gradient.noalias() += residual * jacobian;
}

void addEpipolar(const Parts &p, const Vector3 &translation_m, Normal *sum) {
  const double inverse = 1 / sqrtOf(p.norm2), residual = p.across * inverse;
  const Vector3 g = inverse * p.x - (residual / p.norm2) * Vector3(p.line.x(), p.line.y(), 0);
  add(residual, gradientOfLine(p, translation_m, g), sum);
}

void addDepth(const Parts &p, const Vector3 &point_m, const Vector3 &translation_m, double beta, double root_lambda,
              Normal *sum) {
  const Vector6 d_line = gradientOfLine(p, translation_m, Vector3::UnitY());
  const Vector6 d_scale = gradientOfDirection(p, Vector3(point_m.z(), 0, -point_m.x()));
  add(root_lambda * (beta - 1), (root_lambda / p.scale) * (d_line - beta * d_scale), sum);
}

Normal linearise(const PaperCostConfig &config, Span<const Correspondence> correspondences, const Rigid &pose) {
  Normal sum;
  const double gate = totalGate(config), root_lambda = sqrtOf(config.lambda);
  for (const Correspondence &c : correspondences) {
    const Parts p = partsOf(c, pose);
    const PaperResidual r = residualFrom(p, c.lifted.point_m, pose.translation_m);
    const double cost = r.epipolar2 + config.lambda * square(r.beta - 1);
    if (!(cost < gate) || !r.in_front) {
      sum.cost += gate;
      continue;
    }
    sum.cost += cost;
    addEpipolar(p, pose.translation_m, &sum);
    addDepth(p, c.lifted.point_m, pose.translation_m, r.beta, root_lambda, &sum);
  }
  return sum;
}

// ---- search ----

void drawSample(Random *random, uint32_t count, uint32_t sample[kSampleSize]) {
  sample[0] = random->below(count);
  do sample[1] = random->below(count);
  while (sample[1] == sample[0]);
  do sample[2] = random->below(count);
  while (sample[2] == sample[0] || sample[2] == sample[1]);
}

FixedVector<Rigid, 4> solveSample(Span<const Correspondence> correspondences, const uint32_t sample[kSampleSize]) {
  Vector3 bearing[kSampleSize], point[kSampleSize];
  for (uint32_t k = 0; k < kSampleSize; ++k) {
    bearing[k] = correspondences[sample[k]].direction;
    point[k] = correspondences[sample[k]].lifted.point_m;
  }
  return solveP3p(bearing, point);
}

uint32_t iterationsFor(const PaperCostConfig &config, uint32_t inliers, uint32_t count) {
  const uint32_t most = config.max_iterations;
  const uint32_t least = config.min_iterations < most ? config.min_iterations : most;
  const double share = static_cast<double>(inliers) / count, good = share * share * share;
  if (good > 0.9999) return least;
  if (good < 1e-9) return most;
  const double needed = config.trial_multiplier * logOf(1 - config.success_probability) / logOf(1 - good);
  if (!(needed < most)) return most;
  const uint32_t whole = static_cast<uint32_t>(needed) + 1;
  return whole > least ? whole : least;
}

struct Candidate {
  Rigid pose;
  PaperScore score;
};

// Algorithm 2's inner loop: a pose counts when it beats the best minimal one in either measure.
bool bestOfSample(const PaperCostConfig &config, Span<const Correspondence> correspondences,
                  const FixedVector<Rigid, 4> &poses, PaperScore *best_minimal, Candidate *chosen) {
  bool any = false;
  for (const Rigid &map_from_camera : poses) {
    const Rigid pose = map_from_camera.inverse();
    const PaperScore score = paperScoreOf(config, correspondences, pose);
    if (score.inliers <= best_minimal->inliers && !(score.msac < best_minimal->msac)) continue;
    *best_minimal = score;
    *chosen = {pose, score};
    any = true;
  }
  return any;
}

void keepBetter(const Candidate &candidate, Candidate *best) {
  if (candidate.score.msac < best->score.msac) *best = candidate;
}

Candidate refined(const PaperCostConfig &config, Span<const Correspondence> correspondences, const Rigid &start,
                  int iterations) {
  const Rigid pose = refineWithPaperCost(config, correspondences, start, iterations);
  return {pose, paperScoreOf(config, correspondences, pose)};
}

}  // namespace

PaperResidual paperResidualOf(const Correspondence &c, const Rigid &camera_from_map) {
  return residualFrom(partsOf(c, camera_from_map), c.lifted.point_m, camera_from_map.translation_m);
}

PaperScore paperScoreOf(const PaperCostConfig &config, Span<const Correspondence> correspondences,
                        const Rigid &camera_from_map) {
  const double epipolar_gate2 = epipolarGate2(config), depth_gate2 = square(config.depth_gate);
  const double gate = totalGate(config);
  PaperScore score = {0, 0};
  for (const Correspondence &c : correspondences) {
    const PaperResidual r = paperResidualOf(c, camera_from_map);
    const double depth2 = square(r.beta - 1), cost = r.epipolar2 + config.lambda * depth2;
    if (!r.in_front || !(cost < gate)) {
      score.msac += gate;
      continue;
    }
    score.msac += cost;
    score.inliers += r.epipolar2 <= epipolar_gate2 && depth2 <= depth_gate2;
  }
  return score;
}

Rigid refineWithPaperCost(const PaperCostConfig &config, Span<const Correspondence> correspondences,
                          const Rigid &start, int iterations) {
  Rigid pose = start;
  Normal now = linearise(config, correspondences, pose);
  double damping = 1e-3;
  for (int i = 0; i < iterations; ++i) {
    Matrix6 damped = now.matrix;
    damped.diagonal() *= 1 + damping;
    damped.diagonal().array() += 1e-12;
    const Vector6 step = -damped.ldlt().solve(now.gradient);
    if (!isFinite(step.sum())) break;
    const Rigid next = moved(pose, step);
    const Normal there = linearise(config, correspondences, next);
    const bool better = there.cost < now.cost;
    if (better) {
      pose = next;
      now = there;
    }
    damping = better ? damping * 0.1 : damping * 10;
    if (step.squaredNorm() < 1e-16 || damping > 1e8) break;
  }
  return pose;
}

Estimate estimateWithPaperCost(const PaperCostConfig &config, Span<const Correspondence> correspondences,
                               uint64_t seed) {
  Estimate estimate;
  const uint32_t count = static_cast<uint32_t>(correspondences.size());
  if (count < kSampleSize + 1) return estimate;
  Random random(seed);
  const PaperScore nothing = {totalGate(config) * count, 0};
  PaperScore best_minimal = nothing;
  Candidate best = {Rigid(), nothing};
  uint32_t needed = config.max_iterations;
  while (estimate.iterations < needed) {
    ++estimate.iterations;
    uint32_t sample[kSampleSize];
    drawSample(&random, count, sample);
    Candidate chosen;
    if (!bestOfSample(config, correspondences, solveSample(correspondences, sample), &best_minimal, &chosen))
      continue;
    keepBetter(chosen, &best);
    keepBetter(refined(config, correspondences, chosen.pose, kLocalIterations), &best);
    needed = iterationsFor(config, best.score.inliers, count);
  }
  if (best.score.inliers == 0) return estimate;
  keepBetter(refined(config, correspondences, best.pose, kFinalIterations), &best);
  estimate.camera_from_map = best.pose;
  estimate.inliers = best.score.inliers;
  return estimate;
}

}  // namespace sphc::host
