#include "host/mapping/adjustment.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

#include "host/base/median.h"
#include "host/mapping/pose_block.h"

namespace sphc::host {
namespace {

using Row3 = Eigen::Matrix<double, 1, 3>;
using Matrix23 = Eigen::Matrix<double, 2, 3, Eigen::RowMajor>;

constexpr double kLossSigmas = 3;
constexpr double kFarSigmas = 4.5;  // of a sighting that leaves its track
constexpr double kFarDepth = 3;     // sigmas
constexpr double kIndependentDepths = 10;
constexpr double kNearestM = 0.05;  // of a point before the camera, so that it can be divided by

// What is believed of a calibration: 1 sigma of the focal length, and of the principal point in focal lengths; of
// turns in rad and of shifts in metres.  Sightings share errors of shutters and materials.
constexpr double kLensSigma = 0.01, kMountSigma = 0.01, kIndependentSightings = 1000;

// d(point in the camera) / d(motion of the camera): rotation, shift.
Eigen::Matrix<double, 3, 6> motionOf(const Vector3 &point_m) {
  Eigen::Matrix<double, 3, 6> motion;
  motion << -crossMatrix(point_m), Matrix3::Identity();
  return motion;
}

template <int kRows>
void putPose(const Eigen::Matrix<double, kRows, 3, Eigen::RowMajor> &by_point, const Vector3 &point_m,
             double *out) {
  Eigen::Map<Eigen::Matrix<double, kRows, 7, Eigen::RowMajor>> jacobian(out);
  jacobian.template leftCols<6>() = by_point * motionOf(point_m);
  jacobian.col(6).setZero();
}

// Blocks: point in the world, camera_from_world, what the lens is off.
class RayCost : public ceres::SizedCostFunction<2, 3, 7, 3> {
 public:
  explicit RayCost(const SeenPoint &seen) : ray_(seen.ray), weight_(1 / seen.sigma) {}

  bool Evaluate(double const *const *blocks, double *residuals, double **jacobians) const override {
    const Rigid camera_from_world = poseFrom(blocks[1]);
    const Vector3 point_m = camera_from_world * Eigen::Map<const Vector3>(blocks[0]);
    const double z = std::max(point_m.z(), kNearestM);
    const Vector2 ray = point_m.head<2>() / z;
    Eigen::Map<Vector2> residual(residuals);
    residual = weight_ * (assumedRay(ray, blocks[2]) - ray_);
    if (!jacobians) return true;
    Matrix23 by_point;
    by_point << 1, 0, -ray.x(), 0, 1, -ray.y();
    by_point *= (1 + blocks[2][0]) * weight_ / z;
    if (jacobians[0]) Eigen::Map<Matrix23>(jacobians[0]).noalias() = by_point * camera_from_world.rotation;
    if (jacobians[1]) putPose<2>(by_point, point_m, jacobians[1]);
    if (jacobians[2]) {
      Eigen::Map<Matrix23> by_lens(jacobians[2]);
      by_lens << ray.x(), 1, 0, ray.y(), 0, 1;
      by_lens *= weight_;
    }
    return true;
  }

 private:
  Vector2 ray_;
  double weight_;
};

// What the sensor would measure of a true depth, and its derivative by that depth and by (offset_m, slope).
struct Measurement {
  double depth_m, by_depth, by_offset, by_slope;
};
Measurement measurementOf(double true_m, const double *bias, double mid_m) {
  const double by_depth = 1 / (1 + bias[1]), depth_m = (true_m - bias[0] + bias[1] * mid_m) * by_depth;
  return {depth_m, by_depth, -by_depth, (mid_m - depth_m) * by_depth};
}

// Blocks: point in the world, camera_from_world, offset and slope of the depths, how the depth sensor is off its
// place.  The residual is in the sensor's own measure: were measurements corrected in place, a shorter world would
// have shorter residuals, and would shrink.
class DepthCost : public ceres::SizedCostFunction<1, 3, 7, 2, 5> {
 public:
  DepthCost(const SeenPoint &seen, double mid_m)
      : depth_m_(seen.depth_m), by_mount_(depthByMount(seen)), mid_m_(mid_m), weight_(1 / seen.depth_sigma_m) {}

  bool Evaluate(double const *const *blocks, double *residuals, double **jacobians) const override {
    const Rigid camera_from_world = poseFrom(blocks[1]);
    const Vector3 point_m = camera_from_world * Eigen::Map<const Vector3>(blocks[0]);
    const Measurement expected = measurementOf(point_m.z(), blocks[2], mid_m_);
    residuals[0] = weight_ * (expected.depth_m - depth_m_ - by_mount_.dot(Eigen::Map<const Vector5>(blocks[3])));
    if (!jacobians) return true;
    const Row3 by_point = weight_ * expected.by_depth * Row3::UnitZ();
    if (jacobians[0]) Eigen::Map<Row3>(jacobians[0]).noalias() = by_point * camera_from_world.rotation;
    if (jacobians[1]) putPose<1>(by_point, point_m, jacobians[1]);
    if (jacobians[2]) {
      jacobians[2][0] = weight_ * expected.by_offset;
      jacobians[2][1] = weight_ * expected.by_slope;
    }
    if (jacobians[3]) {
      Eigen::Map<Vector5> by_mount(jacobians[3]);
      by_mount = -weight_ * by_mount_;
    }
    return true;
  }

 private:
  double depth_m_;
  Vector5 by_mount_;
  double mid_m_, weight_;
};

// Block: offset and slope.  Depths of one scene share errors of materials, angles and range: all of them together
// tell no more of the bias than a few independent ones, so the prior weighs so much more.
class BiasPrior : public ceres::SizedCostFunction<2, 2> {
 public:
  BiasPrior(const DepthCalibration &prior, size_t depths) : mean_(prior.mean) {
    const double shared = std::max(1.0, static_cast<double>(depths) / kIndependentDepths);
    for (int i = 0; i < 2; ++i) weight_[i] = std::sqrt(shared / prior.covariance(i, i));
  }
  bool Evaluate(double const *const *blocks, double *residuals, double **jacobians) const override {
    for (int i = 0; i < 2; ++i) residuals[i] = weight_[i] * (blocks[0][i] - mean_[i]);
    if (jacobians && jacobians[0]) {
      Eigen::Map<Eigen::Matrix<double, 2, 2, Eigen::RowMajor>> jacobian(jacobians[0]);
      jacobian = weight_.asDiagonal();
    }
    return true;
  }

 private:
  Vector2 mean_, weight_;
};

// Block: a part of a calibration's change.  `so_far`: what it was changed by before.
template <int kNumbers>
class ChangePrior : public ceres::SizedCostFunction<kNumbers, kNumbers> {
 public:
  using Numbers = Eigen::Matrix<double, kNumbers, 1>;
  ChangePrior(const Numbers &so_far, double sigma) : so_far_(so_far), weight_(1 / sigma) {}

  bool Evaluate(double const *const *blocks, double *residuals, double **jacobians) const override {
    Eigen::Map<Numbers> residual(residuals);
    residual = weight_ * (so_far_ + Eigen::Map<const Numbers>(blocks[0]));
    if (jacobians && jacobians[0]) {
      Eigen::Map<Eigen::Matrix<double, kNumbers, kNumbers, Eigen::RowMajor>> jacobian(jacobians[0]);
      jacobian.setIdentity();
      jacobian *= weight_;
    }
    return true;
  }

 private:
  Numbers so_far_;
  double weight_;
};

class Adjustment {
 public:
  Adjustment(const std::vector<WalkFrame> &frames, const DepthCalibration &prior, Adjusted *adjusted)
      : frames_(frames),
        prior_(prior),
        tracks_(adjusted->tracks),
        poses_(adjusted->world_from_camera),
        bias_(adjusted->bias),
        change_(adjusted->change) {
    keepPlaced();
    for (const auto &pose : poses_) blocks_.push_back(pose ? blockFrom(pose->inverse()) : PoseBlock{});
    for (const Track &track : tracks_) points_.push_back(firstGuess(track));
  }

  void solve(const AdjustmentOptions &options) {
    ceres::Problem::Options shared;
    shared.loss_function_ownership = shared.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ceres::CauchyLoss loss(kLossSigmas);
    PoseManifold manifold;
    ceres::Problem problem(shared);
    ceres::Solver::Options solver;
    auto order = std::make_shared<ceres::ParameterBlockOrdering>();
    state(&problem, &loss, &manifold, order.get(), options);
    if (options.beliefs) options.beliefs->addTo(&problem, &loss, poses_, &blocks_);
    stateCalibration(&problem, order.get(), options);
    solver.linear_solver_ordering = order;
    solver.linear_solver_type = ceres::SPARSE_SCHUR;
    solver.max_num_iterations = options.most_steps;
    solver.num_threads = 1;  // the same bytes every time
    solver.function_tolerance = 1e-5;
    solver.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(solver, &problem, &summary);
    for (size_t i = 0; i < poses_.size(); ++i)
      if (poses_[i]) poses_[i] = poseFrom(blocks_[i].data()).inverse();
  }

  // Removes what is far off.
  AdjustmentSummary judge() {
    AdjustmentSummary summary;
    std::vector<double> ray_sigmas, depth_sigmas, depths_m;
    for (size_t t = 0; t < tracks_.size(); ++t) {
      const auto is_far = [&](const Sighting &s) {
        const SeenPoint &seen = frames_[s.frame].points[s.point];
        const Vector3 point_m = poseFrom(blocks_[s.frame].data()) * points_[t];
        const double off =
            point_m.z() > kNearestM
                ? (assumedRay(point_m.head<2>() / point_m.z(), change_.lens.data()) - seen.ray).norm() / seen.sigma
                : 2 * kFarSigmas;
        ray_sigmas.push_back(off);
        if (seen.hasDepth()) {
          const double off_m = measurementOf(point_m.z(), bias_.data(), prior_.mid_m).depth_m - seen.depth_m -
                               depthByMount(seen).dot(change_.mount);
          depths_m.push_back(std::abs(off_m));
          depth_sigmas.push_back(std::abs(off_m) / seen.depth_sigma_m);
        }
        return off > kFarSigmas;
      };
      Track &track = tracks_[t];
      track.erase(std::remove_if(track.begin(), track.end(), is_far), track.end());
    }
    summary.points = tracks_.size();
    summary.sightings = ray_sigmas.size();
    const auto far =
        std::count_if(depth_sigmas.begin(), depth_sigmas.end(), [](double d) { return d > kFarDepth; });
    if (far > 0) summary.far_depths = static_cast<double>(far) / static_cast<double>(depth_sigmas.size());
    summary.ray_sigmas = median(std::move(ray_sigmas));
    summary.depth_sigmas = median(std::move(depth_sigmas));
    summary.depth_off_m = median(std::move(depths_m));
    tracks_.erase(
        std::remove_if(tracks_.begin(), tracks_.end(), [](const Track &track) { return track.size() < 2; }),
        tracks_.end());
    return summary;
  }

 private:
  // Sightings of frames with a pose, tracks of which a sighting has depth.
  void keepPlaced() {
    for (Track &track : tracks_)
      track.erase(std::remove_if(track.begin(), track.end(), [&](const Sighting &s) { return !poses_[s.frame]; }),
                  track.end());
    const auto is_useless = [&](const Track &track) {
      return track.size() < 2 || std::none_of(track.begin(), track.end(), [&](const Sighting &s) {
               return frames_[s.frame].points[s.point].hasDepth();
             });
    };
    tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(), is_useless), tracks_.end());
  }

  // The middle of where the depths put it.
  Vector3 firstGuess(const Track &track) const {
    std::vector<double> along[3];
    for (const Sighting &s : track) {
      const SeenPoint &seen = frames_[s.frame].points[s.point];
      if (!seen.hasDepth()) continue;
      const Vector3 point_m = *poses_[s.frame] * seen.point_m();
      for (int i = 0; i < 3; ++i) along[i].push_back(point_m[i]);
    }
    return {median(along[0]), median(along[1]), median(along[2])};
  }

  void state(ceres::Problem *problem, ceres::LossFunction *loss, ceres::Manifold *manifold,
             ceres::ParameterBlockOrdering *order, const AdjustmentOptions &options) {
    size_t depths = 0;
    bool is_held = options.beliefs && options.beliefs->hasAnchors();
    for (size_t t = 0; t < tracks_.size(); ++t) {
      for (const Sighting &s : tracks_[t]) {
        const SeenPoint &seen = frames_[s.frame].points[s.point];
        double *pose = blocks_[s.frame].data(), *point = points_[t].data();
        problem->AddResidualBlock(new RayCost(seen), loss, point, pose, change_.lens.data());
        depths += seen.hasDepth();
        if (seen.hasDepth())
          problem->AddResidualBlock(new DepthCost(seen, prior_.mid_m), loss, point, pose, bias_.data(),
                                    change_.mount.data());
      }
      order->AddElementToGroup(points_[t].data(), 0);
    }
    for (size_t i = 0; i < poses_.size(); ++i) {
      if (!poses_[i]) continue;
      problem->AddParameterBlock(blocks_[i].data(), 7, manifold);
      if (!is_held || options.poses_are_held) problem->SetParameterBlockConstant(blocks_[i].data());
      is_held = true;
      order->AddElementToGroup(blocks_[i].data(), 1);
    }
    problem->AddResidualBlock(new BiasPrior(prior_, depths), nullptr, bias_.data());
    order->AddElementToGroup(bias_.data(), 1);
  }

  // Held where it is, unless it is asked for.
  void stateCalibration(ceres::Problem *problem, ceres::ParameterBlockOrdering *order,
                        const AdjustmentOptions &options) {
    const CalibrationChange &so_far = options.change_so_far;
    stateChange<3>(problem, order, options.lens_is_free, so_far.lens, kLensSigma, &change_.lens);
    stateChange<5>(problem, order, options.mount_is_free, so_far.mount, kMountSigma, &change_.mount);
  }
  template <int kNumbers>
  void stateChange(ceres::Problem *problem, ceres::ParameterBlockOrdering *order, bool is_free,
                   const Eigen::Matrix<double, kNumbers, 1> &so_far, double sigma,
                   Eigen::Matrix<double, kNumbers, 1> *change) const {
    problem->AddParameterBlock(change->data(), kNumbers);
    order->AddElementToGroup(change->data(), 1);
    const double shared = std::max(1.0, static_cast<double>(problem->NumResidualBlocks()) / kIndependentSightings);
    if (is_free)
      problem->AddResidualBlock(new ChangePrior<kNumbers>(so_far, sigma / std::sqrt(shared)), nullptr,
                                change->data());
    else
      problem->SetParameterBlockConstant(change->data());
  }

  const std::vector<WalkFrame> &frames_;
  DepthCalibration prior_;
  std::vector<Track> &tracks_;
  FramePoses &poses_;
  Vector2 &bias_;
  CalibrationChange &change_;
  std::vector<PoseBlock> blocks_;
  std::vector<Vector3> points_;
};

}  // namespace

AdjustmentSummary adjust(const std::vector<WalkFrame> &frames, const DepthCalibration &prior,
                         const AdjustmentOptions &options, Adjusted *adjusted) {
  Adjustment adjustment(frames, prior, adjusted);
  adjustment.solve(options);
  return adjustment.judge();
}

}  // namespace sphc::host
