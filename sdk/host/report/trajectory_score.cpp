#include "host/report/trajectory_score.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sphc::host {
namespace {

using Places = Eigen::Matrix3Xd;

Places errorsOf(const Eigen::Matrix4d &true_from_estimated, const Places &estimated, const Places &truth) {
  return ((true_from_estimated.topLeftCorner<3, 3>() * estimated).colwise() +
          true_from_estimated.col(3).head<3>()) -
         truth;
}

std::optional<double> worstRevisit(const Places &truth, const Places &errors) {
  constexpr double kNearM = 0.5, kWayM = 5;
  std::vector<double> way_m(static_cast<size_t>(truth.cols()));
  std::optional<double> worst2;
  for (Eigen::Index i = 1; i < truth.cols(); ++i) {
    const auto now = static_cast<size_t>(i);
    way_m[now] = way_m[now - 1] + (truth.col(i) - truth.col(i - 1)).norm();
    for (Eigen::Index j = 0; way_m[now] - way_m[static_cast<size_t>(j)] > kWayM; ++j) {
      if ((truth.col(i) - truth.col(j)).squaredNorm() > kNearM * kNearM) continue;
      worst2 = std::max(worst2.value_or(0), (errors.col(i) - errors.col(j)).squaredNorm());
    }
  }
  return worst2 ? std::optional(std::sqrt(*worst2)) : std::nullopt;
}

double rmse(const Places &errors) { return std::sqrt(errors.colwise().squaredNorm().mean()); }

}  // namespace

TrajectoryScore scoreTrajectory(const std::vector<PosePair> &poses) {
  if (poses.size() < kFewestScored)
    throw std::runtime_error(
        "only " + std::to_string(poses.size()) +
        " frames have both a pose that was found and one that is known; 3 are needed to compare");
  const auto count = static_cast<Eigen::Index>(poses.size());
  Places estimated(3, count), truth(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    estimated.col(i) = poses[static_cast<size_t>(i)].estimated.translation_m;
    truth.col(i) = poses[static_cast<size_t>(i)].truth.translation_m;
  }
  const Eigen::Matrix4d rigid = Eigen::umeyama(estimated, truth, false),
                        similar = Eigen::umeyama(estimated, truth, true);
  TrajectoryScore score;
  score.frames = poses.size();
  score.true_from_estimated = {rigid.topLeftCorner<3, 3>(), rigid.col(3).head<3>()};
  const Places errors = errorsOf(rigid, estimated, truth);
  score.rigid_rmse_m = rmse(errors);
  score.rigid_worst_m = errors.colwise().norm().maxCoeff();
  score.revisit_worst_m = worstRevisit(truth, errors);
  score.similarity_rmse_m = rmse(errorsOf(similar, estimated, truth));
  score.scale = 1 / std::cbrt(similar.topLeftCorner<3, 3>().determinant());
  std::vector<double> turns_deg;
  for (const PosePair &pose : poses) {
    const Matrix3 placed = score.true_from_estimated.rotation * pose.estimated.rotation;
    turns_deg.push_back(rotationAngle(pose.truth.rotation.transpose() * placed) * 180 / kPi);
  }
  std::sort(turns_deg.begin(), turns_deg.end());
  score.rotation_median_deg = turns_deg[turns_deg.size() / 2];
  score.rotation_worst_deg = turns_deg.back();
  return score;
}

bool isTruthInverse(const std::vector<PosePair> &poses) {
  constexpr double kFarBetter = 0.3;
  std::vector<PosePair> turned = poses;
  for (PosePair &pose : turned) pose.truth = pose.truth.inverse();
  const TrajectoryScore given = scoreTrajectory(poses), inverse = scoreTrajectory(turned);
  return inverse.rigid_rmse_m < kFarBetter * given.rigid_rmse_m &&
         inverse.rotation_median_deg < kFarBetter * given.rotation_median_deg;
}

}  // namespace sphc::host
