#include "host/mapping/pose_graph.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <queue>

#include "host/mapping/pose_block.h"

namespace sphc::host {
namespace {

using Matrix66 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
using Matrix67 = Eigen::Matrix<double, 6, 7, Eigen::RowMajor>;

// A link is never surer than this: its depths share a bias, and its matches one image.
constexpr double kLeastRad = 0.002, kLeastM = 0.004;
constexpr double kLinkLossSigmas = 3;
constexpr int kMostSteps = 50;
constexpr uint32_t kFewestBridges = 3, kSureInliers = 60;
constexpr double kMostOffM = 0.15, kMostOffRad = 0.08;

Matrix6 floored(Matrix6 covariance) {
  covariance.diagonal().head<3>().array() += kLeastRad * kLeastRad;
  covariance.diagonal().tail<3>().array() += kLeastM * kLeastM;
  return covariance;
}

// Of the poses' b_from_a after the link's a_from_b.
Vector6 errorOf(const Rigid &b_from_b) {
  Vector6 error;
  error << vectorFromRotation(b_from_b.rotation), b_from_b.translation_m;
  return error;
}

// How a small motion of a frame's camera moves the error.
Matrix6 motionOfError(const Rigid &error) {
  Matrix6 motion = Matrix6::Identity();
  motion.topLeftCorner<3, 3>() -= 0.5 * crossMatrix(vectorFromRotation(error.rotation));
  motion.bottomLeftCorner<3, 3>() = -crossMatrix(error.translation_m);
  return motion;
}

// T exp(xi) = exp(adjoint(T) xi) T
Matrix6 adjoint(const Rigid &pose) {
  Matrix6 result = Matrix6::Zero();
  result.topLeftCorner<3, 3>() = result.bottomRightCorner<3, 3>() = pose.rotation;
  result.bottomLeftCorner<3, 3>() = crossMatrix(pose.translation_m) * pose.rotation;
  return result;
}

// Blocks: camera_from_world of a and b.
class LinkCost : public ceres::SizedCostFunction<6, 7, 7> {
 public:
  explicit LinkCost(const FrameLink &link) : b_from_a_(link.b_from_a), a_from_b_(link.b_from_a.inverse()) {
    whiten_ = floored(link.covariance).inverse().llt().matrixU();
  }

  bool Evaluate(double const *const *blocks, double *residuals, double **jacobians) const override {
    const Rigid error = poseFrom(blocks[1]) * poseFrom(blocks[0]).inverse() * a_from_b_;
    Eigen::Map<Vector6> residual(residuals);
    residual = whiten_ * errorOf(error);
    if (!jacobians) return true;
    const Matrix6 by_b = whiten_ * motionOfError(error);
    if (jacobians[1]) put(by_b, jacobians[1]);
    if (jacobians[0]) put(-by_b * adjoint(error * b_from_a_), jacobians[0]);
    return true;
  }

 private:
  static void put(const Matrix6 &derivative, double *out) {
    Eigen::Map<Matrix67> jacobian(out);
    jacobian.leftCols<6>() = derivative;
    jacobian.col(6).setZero();
  }

  Rigid b_from_a_, a_from_b_;
  Matrix6 whiten_;
};

uint32_t rootOf(std::vector<uint32_t> *parent, uint32_t i) {
  while ((*parent)[i] != i) i = (*parent)[i] = (*parent)[(*parent)[i]];
  return i;
}

}  // namespace

std::vector<uint32_t> connectedParts(size_t frames, const std::vector<FrameLink> &links) {
  std::vector<uint32_t> parent(frames), size(frames), parts(frames);
  std::iota(parent.begin(), parent.end(), 0u);
  for (const FrameLink &link : links) {
    const uint32_t a = rootOf(&parent, link.frames.a), b = rootOf(&parent, link.frames.b);
    parent[std::max(a, b)] = std::min(a, b);
  }
  std::vector<uint32_t> roots;
  for (uint32_t i = 0; i < frames; ++i) {
    const uint32_t root = rootOf(&parent, i);
    if (++size[root] == 1) roots.push_back(root);
  }
  std::stable_sort(roots.begin(), roots.end(), [&](uint32_t x, uint32_t y) { return size[x] > size[y]; });
  std::vector<uint32_t> label(frames);
  for (uint32_t part = 0; part < roots.size(); ++part) label[roots[part]] = part;
  for (uint32_t i = 0; i < frames; ++i) parts[i] = label[rootOf(&parent, i)];
  return parts;
}

size_t dropWeakBridges(size_t frames, std::vector<FrameLink> *links) {
  std::vector<FrameLink> in_time;
  for (const FrameLink &link : *links)
    if (link.frames.gap() <= kMostGapInTime) in_time.push_back(link);
  const std::vector<uint32_t> stretch = connectedParts(frames, in_time);
  const auto ends = [&](const FrameLink &link) {
    return std::minmax({stretch[link.frames.a], stretch[link.frames.b]});
  };
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> support;
  for (const FrameLink &link : *links) support[ends(link)] += link.inliers >= kSureInliers ? kFewestBridges : 1;
  const auto is_weak = [&](const FrameLink &link) {
    const auto between = ends(link);
    return between.first != between.second && support[between] < kFewestBridges;
  };
  const size_t before = links->size();
  links->erase(std::remove_if(links->begin(), links->end(), is_weak), links->end());
  return before - links->size();
}

FramePoses posesAlongLinks(size_t frames, const std::vector<FrameLink> &links, const std::vector<uint32_t> &parts) {
  std::vector<std::vector<uint32_t>> links_of(frames);
  for (uint32_t k = 0; k < links.size(); ++k) {
    links_of[links[k].frames.a].push_back(k);
    links_of[links[k].frames.b].push_back(k);
  }
  FramePoses poses(frames);
  struct Step {
    uint32_t inliers, link;
    bool operator<(const Step &other) const {
      return inliers != other.inliers ? inliers < other.inliers : link > other.link;
    }
  };
  std::priority_queue<Step> open;
  const auto place = [&](uint32_t frame, const Rigid &pose) {
    poses[frame] = pose;
    for (uint32_t k : links_of[frame]) open.push({links[k].inliers, k});
  };
  const auto first = std::find(parts.begin(), parts.end(), 0u);
  if (first != parts.end()) place(static_cast<uint32_t>(first - parts.begin()), Rigid());
  while (!open.empty()) {
    const FrameLink &link = links[open.top().link];
    open.pop();
    const auto [a, b] = link.frames;
    if (poses[a] && !poses[b]) place(b, *poses[a] * link.b_from_a.inverse());
    if (poses[b] && !poses[a]) place(a, *poses[b] * link.b_from_a);
  }
  return poses;
}

void adjustToLinks(const std::vector<FrameLink> &links, FramePoses *world_from_camera) {
  std::vector<PoseBlock> blocks(world_from_camera->size());
  ceres::Problem problem;
  bool has_first = false;
  for (size_t i = 0; i < blocks.size(); ++i) {
    if (!(*world_from_camera)[i]) continue;
    blocks[i] = blockFrom((*world_from_camera)[i]->inverse());
    problem.AddParameterBlock(blocks[i].data(), 7, new PoseManifold);
    if (!has_first) problem.SetParameterBlockConstant(blocks[i].data());
    has_first = true;
  }
  for (const FrameLink &link : links) {
    if (!(*world_from_camera)[link.frames.a] || !(*world_from_camera)[link.frames.b]) continue;
    problem.AddResidualBlock(new LinkCost(link), new ceres::CauchyLoss(kLinkLossSigmas),
                             blocks[link.frames.a].data(), blocks[link.frames.b].data());
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = kMostSteps;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  for (size_t i = 0; i < blocks.size(); ++i)
    if ((*world_from_camera)[i]) (*world_from_camera)[i] = poseFrom(blocks[i].data()).inverse();
}

bool isConsistent(const FrameLink &link, const FramePoses &world_from_camera) {
  const std::optional<Rigid> &a = world_from_camera[link.frames.a], &b = world_from_camera[link.frames.b];
  if (!a || !b) return false;
  const Rigid error = b->inverse() * *a * link.b_from_a.inverse();
  return error.translation_m.norm() < kMostOffM && rotationAngle(error.rotation) < kMostOffRad;
}

}  // namespace sphc::host
