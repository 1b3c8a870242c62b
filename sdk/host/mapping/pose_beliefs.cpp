#include "host/mapping/pose_beliefs.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <map>

#include "host/base/in_seconds.h"
#include "host/mapping/pose_costs.h"
#include "host/mapping/pose_graph.h"

namespace sphc::host {
namespace {

// Beyond so many sigmas, and what links are off themselves, a pose or a step is contradicted.
constexpr double kSigmas = 4, kLinkOffM = 0.02, kLinkOffRad = 0.02;
constexpr double kDriftOfTurn = 0.01;  // of odometry: radians a radian
// A headset moves no faster, so a step that says so is a jump of the tracking.
constexpr double kFastestM = 5, kFastestRad = 10;  // a second
constexpr size_t kFewestAnchors = 5;
constexpr double kLeastShare = 0.25;
constexpr double kDisproved = 5;  // times what contradicts a pose: of another world, or of other axes

bool isFinite(const Rigid &pose) { return pose.rotation.allFinite() && pose.translation_m.allFinite(); }

// A step of odometry with its covariance.
FrameLink stepOf(const FramePair &frames, const Rigid &b_from_a, const PoseTrust &trust) {
  FrameLink step;
  step.frames = frames;
  step.b_from_a = b_from_a;
  const double way_m = b_from_a.translation_m.norm(), turn = kDriftOfTurn * rotationAngle(b_from_a.rotation);
  step.covariance.diagonal().head<3>().setConstant(trust.drift_rad * trust.drift_rad * way_m + turn * turn);
  step.covariance.diagonal().tail<3>().setConstant(trust.drift_m * trust.drift_m * way_m);
  return step;
}

bool agree(const FrameLink &step, const Rigid &b_from_a) {
  return isWithin(b_from_a * step.b_from_a.inverse(), kSigmas * std::sqrt(step.covariance(3, 3)) + kLinkOffM,
                  kSigmas * std::sqrt(step.covariance(0, 0)) + kLinkOffRad);
}

std::vector<FramePair> pairsOf(const std::vector<FrameLink> &links) {
  std::vector<FramePair> pairs;
  for (const FrameLink &link : links) pairs.push_back(link.frames);
  return pairs;
}

}  // namespace

PoseBeliefs::PoseBeliefs(const std::vector<WalkFrame> &frames, const PoseTrust &trust)
    : trust_(trust), told_(frames.size()), anchors_(frames.size()) {
  if (trust.use == PoseUse::kNone) return;
  for (size_t i = 0; i < frames.size(); ++i)
    if (frames[i].told_world_from_camera && isFinite(*frames[i].told_world_from_camera))
      told_[i] = frames[i].told_world_from_camera;
  if (trust.use != PoseUse::kOdometry) return;
  std::optional<uint32_t> before;
  for (uint32_t i = 0; i < frames.size(); ++i) {
    if (!told_[i]) continue;
    if (before && frames[*before].recording == frames[i].recording &&
        frames[*before].told_piece == frames[i].told_piece) {
      const Rigid b_from_a = told_[i]->inverse() * *told_[*before];
      const double s = inSeconds(frames[i].time_ns - frames[*before].time_ns);
      told_steps_.push_back(stepOf({*before, i}, b_from_a, trust));
      if (isWithin(b_from_a, kFastestM * s, kFastestRad * s)) steps_.push_back(told_steps_.back());
    }
    before = i;
  }
}

bool PoseBeliefs::hasAnchors() const {
  return std::any_of(anchors_.begin(), anchors_.end(), [](const auto &pose) { return pose.has_value(); });
}

void PoseBeliefs::judge(const std::vector<FrameLink> &links) {
  if (trust_.use == PoseUse::kOdometry) judgeSteps(links);
  if (trust_.use == PoseUse::kApproximate) judgeAnchors(links);
}

void PoseBeliefs::judgeSteps(const std::vector<FrameLink> &links) {
  std::map<FramePair, const FrameLink *> link_of;
  for (const FrameLink &link : links) link_of[link.frames] = &link;
  size_t compared = 0, contradicted = 0;
  const auto is_contradicted = [&](const FrameLink &step) {
    const auto found = link_of.find(step.frames);
    if (found == link_of.end()) return false;
    const bool is_off = !agree(step, found->second->b_from_a);
    ++compared;
    contradicted += is_off;
    return is_off;
  };
  steps_.erase(std::remove_if(steps_.begin(), steps_.end(), is_contradicted), steps_.end());
  if (2 * contradicted > compared) steps_.clear();
}

// Do the told poses lie to each other as the link says?  A turn of the one moves the other.
bool PoseBeliefs::agrees(const FrameLink &link) const {
  const std::optional<Rigid> &a = told_[link.frames.a], &b = told_[link.frames.b];
  if (!a || !b) return false;
  const Rigid error = b->inverse() * *a * link.b_from_a.inverse();
  const double limit_rad = kSigmas * std::sqrt(2.0) * trust_.sigma_rad;
  return isWithin(
      error, kSigmas * std::sqrt(2.0) * trust_.sigma_m + limit_rad * link.b_from_a.translation_m.norm() + kLinkOffM,
      limit_rad + kLinkOffRad);
}

void PoseBeliefs::judgeAnchors(const std::vector<FrameLink> &links) {
  std::vector<FramePair> agreeing;
  for (const FrameLink &link : links)
    if (agrees(link)) agreeing.push_back(link.frames);
  const std::vector<uint32_t> part = connectedParts(told_.size(), pairsOf(links)),
                              group = connectedParts(told_.size(), agreeing);
  std::map<uint32_t, size_t> told_of_part, size_of_group;
  std::map<uint32_t, uint32_t> group_of_part;
  for (size_t i = 0; i < told_.size(); ++i) {
    if (!told_[i]) continue;
    ++told_of_part[part[i]];
    ++size_of_group[group[i]];
    const auto largest = group_of_part.emplace(part[i], group[i]).first;
    largest->second = std::min(largest->second, group[i]);  // labels are in order of size
  }
  for (size_t i = 0; i < told_.size(); ++i) {
    anchors_[i].reset();
    const size_t size = size_of_group[group[i]];
    const size_t fewest = std::max<size_t>(2, std::min(kFewestAnchors, told_of_part[part[i]]));
    if (told_[i] && group[i] == group_of_part[part[i]] && size >= fewest &&
        static_cast<double>(size) >= kLeastShare * static_cast<double>(told_of_part[part[i]]))
      anchors_[i] = told_[i];
  }
}

void PoseBeliefs::dropContradicted(const FramePoses &world_from_camera) {
  const auto is_contradicted = [&](const FrameLink &step) {
    return world_from_camera[step.frames.a] && !isConsistent(step, world_from_camera);
  };
  steps_.erase(std::remove_if(steps_.begin(), steps_.end(), is_contradicted), steps_.end());
}

std::vector<uint32_t> PoseBeliefs::parts(const std::vector<FrameLink> &links) const {
  std::vector<FramePair> pairs = pairsOf(links);
  std::vector<bool> has_link(told_.size());
  for (const FramePair &pair : pairs) has_link[pair.a] = has_link[pair.b] = true;
  for (const FrameLink &step : steps_) pairs.push_back(step.frames);
  std::optional<uint32_t> before;
  for (uint32_t i = 0; i < told_.size(); ++i) {
    if (!anchors_[i] || !has_link[i]) continue;
    if (before) pairs.push_back({*before, i});
    before = i;
  }
  return connectedParts(told_.size(), pairs);
}

void PoseBeliefs::dropOutside(const std::vector<uint32_t> &parts) {
  for (size_t i = 0; i < anchors_.size(); ++i)
    if (parts[i] != 0) anchors_[i].reset();
}

void PoseBeliefs::addTo(ceres::Problem *problem, ceres::LossFunction *loss, const FramePoses &world_from_camera,
                        std::vector<PoseBlock> *blocks) const {
  for (size_t i = 0; i < anchors_.size(); ++i)
    if (anchors_[i] && world_from_camera[i])
      problem->AddResidualBlock(new AnchorCost(*anchors_[i], trust_.sigma_m, trust_.sigma_rad), loss,
                                (*blocks)[i].data());
  for (const FrameLink &step : steps_)
    if (world_from_camera[step.frames.a] && world_from_camera[step.frames.b])
      problem->AddResidualBlock(new LinkCost(step), loss, (*blocks)[step.frames.a].data(),
                                (*blocks)[step.frames.b].data());
}

size_t PoseBeliefs::toldCount() const {
  if (trust_.use == PoseUse::kOdometry) return told_steps_.size();
  return placedCount(told_);
}

size_t PoseBeliefs::contradictedBy(const FramePoses &mapped) const {
  size_t count = 0;
  for (const FrameLink &step : told_steps_)
    if (mapped[step.frames.a] && mapped[step.frames.b])
      count += !agree(step, mapped[step.frames.b]->inverse() * *mapped[step.frames.a]);
  if (trust_.use == PoseUse::kApproximate)
    for (size_t i = 0; i < told_.size(); ++i)
      if (told_[i] && mapped[i])
        count += !hasAnchors() || !isWithin(mapped[i]->inverse() * *told_[i], kSigmas * trust_.sigma_m + kLinkOffM,
                                            kSigmas * trust_.sigma_rad + kLinkOffRad);
  return count;
}

void PoseBeliefs::dropDisproved(const FramePoses &mapped) {
  size_t compared = 0, disproved = 0;
  for (size_t i = 0; i < told_.size(); ++i) {
    if (!told_[i] || !mapped[i]) continue;
    ++compared;
    disproved += !isWithin(mapped[i]->inverse() * *told_[i], kDisproved * kSigmas * trust_.sigma_m,
                           kDisproved * kSigmas * trust_.sigma_rad);
  }
  if (2 * disproved <= compared) return;
  for (auto &anchor : anchors_) anchor.reset();
}

Matrix3 toldAxesFromMapped(const FramePoses &told, const FramePoses &mapped) {
  Matrix3 sum = Matrix3::Zero();
  for (size_t i = 0; i < told.size(); ++i)
    if (told[i] && mapped[i]) sum += told[i]->rotation * mapped[i]->rotation.transpose();
  if (sum.isZero()) return Matrix3::Identity();
  const Eigen::JacobiSVD<Matrix3> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3 mirror = Matrix3::Identity();
  mirror(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  return svd.matrixU() * mirror * svd.matrixV().transpose();
}

}  // namespace sphc::host
