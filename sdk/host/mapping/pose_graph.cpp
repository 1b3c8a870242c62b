#include "host/mapping/pose_graph.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <queue>

#include "host/mapping/pose_block.h"
#include "host/mapping/pose_costs.h"
#include "host/mapping/root_of.h"

namespace sphc::host {
namespace {

// What beliefs are far off by at first must not lose its say at once.
constexpr double kWideLossSigmas = 30, kLinkLossSigmas = 3;
constexpr int kMostSteps = 50;
constexpr uint32_t kFewestBridges = 3, kSureInliers = 60;
constexpr double kMostOffM = 0.15, kMostOffRad = 0.08;

void solveLinks(const std::vector<FrameLink> &links, const PoseBeliefs &beliefs, double loss_sigmas,
                FramePoses *world_from_camera) {
  std::vector<PoseBlock> blocks(world_from_camera->size());
  ceres::Problem::Options shared;
  shared.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::CauchyLoss loss(loss_sigmas);
  ceres::Problem problem(shared);
  bool is_held = beliefs.hasAnchors();
  for (size_t i = 0; i < blocks.size(); ++i) {
    if (!(*world_from_camera)[i]) continue;
    blocks[i] = blockFrom((*world_from_camera)[i]->inverse());
    problem.AddParameterBlock(blocks[i].data(), 7, new PoseManifold);
    if (!is_held) problem.SetParameterBlockConstant(blocks[i].data());
    is_held = true;
  }
  for (const FrameLink &link : links)
    if ((*world_from_camera)[link.frames.a] && (*world_from_camera)[link.frames.b])
      problem.AddResidualBlock(new LinkCost(link), &loss, blocks[link.frames.a].data(),
                               blocks[link.frames.b].data());
  beliefs.addTo(&problem, &loss, *world_from_camera, &blocks);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = kMostSteps;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  for (size_t i = 0; i < blocks.size(); ++i)
    if ((*world_from_camera)[i]) (*world_from_camera)[i] = poseFrom(blocks[i].data()).inverse();
}

}  // namespace

std::vector<uint32_t> connectedParts(size_t frames, const std::vector<FramePair> &pairs) {
  std::vector<uint32_t> parent(frames), size(frames), parts(frames);
  std::iota(parent.begin(), parent.end(), 0u);
  for (const FramePair &pair : pairs) {
    const uint32_t a = rootOf(&parent, pair.a), b = rootOf(&parent, pair.b);
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

std::vector<uint32_t> connectedParts(size_t frames, const std::vector<FrameLink> &links) {
  std::vector<FramePair> pairs;
  for (const FrameLink &link : links) pairs.push_back(link.frames);
  return connectedParts(frames, pairs);
}

size_t dropWeakBridges(size_t frames, std::vector<FrameLink> *links) {
  std::vector<FrameLink> in_time;
  for (const FrameLink &link : *links)
    if (!link.is_loop) in_time.push_back(link);
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

FramePoses posesAlongLinks(const std::vector<FrameLink> &links, const std::vector<uint32_t> &parts,
                           const PoseBeliefs &beliefs) {
  std::vector<const FrameLink *> all;
  for (const FrameLink &link : links) all.push_back(&link);
  for (const FrameLink &step : beliefs.steps()) all.push_back(&step);
  std::vector<std::vector<uint32_t>> links_of(parts.size());
  for (uint32_t k = 0; k < all.size(); ++k)
    for (uint32_t frame : {all[k]->frames.a, all[k]->frames.b}) links_of[frame].push_back(k);
  FramePoses poses(parts.size());
  struct Step {
    uint32_t inliers, link;
    bool operator<(const Step &other) const {
      return inliers != other.inliers ? inliers < other.inliers : link > other.link;
    }
  };
  std::priority_queue<Step> open;
  const auto place = [&](uint32_t frame, const Rigid &pose) {
    poses[frame] = pose;
    for (uint32_t k : links_of[frame]) open.push({all[k]->inliers, k});
  };
  const auto first = std::find(parts.begin(), parts.end(), 0u);
  if (!beliefs.hasAnchors() && first != parts.end()) place(static_cast<uint32_t>(first - parts.begin()), Rigid());
  for (uint32_t i = 0; i < parts.size(); ++i)
    if (beliefs.anchors()[i] && parts[i] == 0) place(i, *beliefs.anchors()[i]);
  while (!open.empty()) {
    const FrameLink &link = *all[open.top().link];
    open.pop();
    const auto [a, b] = link.frames;
    if (poses[a] && !poses[b]) place(b, *poses[a] * link.b_from_a.inverse());
    if (poses[b] && !poses[a]) place(a, *poses[b] * link.b_from_a);
  }
  return poses;
}

void adjustToLinks(const std::vector<FrameLink> &links, const PoseBeliefs &beliefs, FramePoses *world_from_camera) {
  if (beliefs.hasAnchors()) solveLinks(links, beliefs, kWideLossSigmas, world_from_camera);
  solveLinks(links, beliefs, kLinkLossSigmas, world_from_camera);
}

bool isConsistent(const FrameLink &link, const FramePoses &world_from_camera) {
  const std::optional<Rigid> &a = world_from_camera[link.frames.a], &b = world_from_camera[link.frames.b];
  if (!a || !b) return false;
  return isWithin(b->inverse() * *a * link.b_from_a.inverse(), kMostOffM, kMostOffRad);
}

}  // namespace sphc::host
