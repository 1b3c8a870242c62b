#include "host/mapping/adjustment.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

#include "host/base/median.h"
#include "host/mapping/adjustment_costs.h"
#include "host/mapping/pose_block.h"

namespace sphc::host {
namespace {

constexpr double kLossSigmas = 3;
constexpr double kFarSigmas = 4.5;  // of a sighting that leaves its track
constexpr double kFarDepth = 3;     // sigmas
constexpr double kIndependentDepths = 10;
// What is believed of a calibration: 1 sigma of the focal length, and of the principal point in focal lengths; of
// turns in rad and of shifts in metres.  Sightings share errors of shutters and materials.
constexpr double kLensSigma = 0.01, kMountSigma = 0.01, kIndependentSightings = 1000;

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
