#include "host/recording/foreign/frame_tree.h"

#include <algorithm>
#include <cmath>

namespace sphc::recording {

namespace {

constexpr int64_t kMostGapNs = 1000000000;  // between transforms of a link; drift of a map is told seldom
constexpr size_t kMostLinks = 256;          // one after the other; a robot has some ten
constexpr double kSameTransform = 1e-9;     // metres, and of a quaternion's numbers
constexpr sphc_rigid kSameFrame = {{1, 0, 0, 0}, {0, 0, 0}};

sphc_rigid composed(const sphc_rigid &c_from_b, const sphc_rigid &b_from_a) {
  sphc_rigid c_from_a;
  sphc_rigid_compose(&c_from_b, &b_from_a, &c_from_a);
  return c_from_a;
}

sphc_rigid inverted(const sphc_rigid &b_from_a) {
  sphc_rigid a_from_b;
  sphc_rigid_inverse(&b_from_a, &a_from_b);
  return a_from_b;
}

// To rounding.
bool areEqual(const sphc_rigid &a, const sphc_rigid &b) {
  double cosine = 0, apart_m = 0;
  for (int i = 0; i < 4; ++i) cosine += a.q_wxyz[i] * b.q_wxyz[i];
  for (int i = 0; i < 3; ++i) apart_m = std::max(apart_m, std::abs(a.t_m[i] - b.t_m[i]));
  double apart = 0;
  for (int i = 0; i < 4; ++i)
    apart = std::max(apart, std::abs(a.q_wxyz[i] - std::copysign(1.0, cosine) * b.q_wxyz[i]));
  return apart <= kSameTransform && apart_m <= kSameTransform;
}

bool areAllEqual(const std::vector<TimedPose> &samples) {
  return std::all_of(samples.begin(), samples.end(),
                     [&](const TimedPose &sample) { return areEqual(samples[0].pose, sample.pose); });
}

}  // namespace

void FrameTree::addFixed(const std::string &parent, const std::string &child, const sphc_rigid &parent_from_child) {
  Link &link = links_[child];
  if (!link.parent.empty() || rootOf(parent) == child) return;
  link.parent = parent;
  link.fixed = parent_from_child;
}

void FrameTree::addMoving(const Teller &teller, const std::string &parent, const std::string &child,
                          const TimedPose &parent_from_child) {
  const auto [found, is_new] = claim_by_names_.try_emplace({teller.topic, parent, child}, claims_.size());
  if (is_new) claims_.push_back({teller, parent, child, {}});
  if (is_new && teller.is_odometry) odometry_.insert(child);
  claims_[found->second].samples.push_back(parent_from_child);
}

void FrameTree::resolve() {
  for (Claim &claim : claims_)
    std::stable_sort(claim.samples.begin(), claim.samples.end(),
                     [](const TimedPose &a, const TimedPose &b) { return a.time_ns < b.time_ns; });
  for (const Claim &claim : claims_)
    if (isStill(claim)) addFixed(claim.parent, claim.child, claim.samples[0].pose);
  for (const Rank rank : {Rank::kTransforms, Rank::kTransformsOfAPart, Rank::kOdometry})
    for (Claim &claim : claims_)
      if (rankOf(claim) == rank && !isStill(claim)) hang(rank, &claim);
}

// Whoever has no topic of what is fixed tells it over and over.
bool FrameTree::isStill(const Claim &claim) const {
  return !claim.teller.is_odometry && claim.samples.size() > 1 && odometry_.count(claim.child) == 0 &&
         areAllEqual(claim.samples);
}

FrameTree::Rank FrameTree::rankOf(const Claim &claim) const {
  sphc_rigid body_from_child;
  if (claim.teller.is_odometry) return Rank::kOdometry;
  return bodyOf(claim.child, body_from_child) == claim.child ? Rank::kTransforms : Rank::kTransformsOfAPart;
}

// What is told of a frame is told of the body that it is fixed to.
void FrameTree::hang(Rank rank, Claim *claim) {
  sphc_rigid body_from_child;
  const std::string body = bodyOf(claim->child, body_from_child);
  if (claim->parent.empty() || claim->child.empty() ||
      (links_[body].parent.empty() && rootOf(claim->parent) == body)) {
    if (claim->teller.is_odometry && !useless_)
      useless_ = Useless{claim->teller.topic, claim->parent, claim->child};
    return;
  }
  Link &link = links_[body];
  if (link.parent.empty()) {
    link.parent = claim->parent;
    link.rank = rank;
    link.topic = claim->teller.topic;
    link.moving = std::move(claim->samples);
    for (TimedPose &sample : link.moving) {
      if (body != claim->child) sample.pose = composed(sample.pose, inverted(body_from_child));
      link.track.add(sample.time_ns, sample.pose);
    }
  } else if (link.rank == rank && link.topic != claim->teller.topic && link.rival.empty()) {
    link.rival = claim->teller.topic;
  }
}

std::vector<const FrameTree::Link *> FrameTree::linksOf(std::string frame) const {
  std::vector<const Link *> links;
  for (auto found = links_.find(frame); found != links_.end() && links.size() < kMostLinks;
       found = links_.find(frame)) {
    if (found->second.parent.empty()) break;
    links.push_back(&found->second);
    frame = found->second.parent;
  }
  return links;
}

std::string FrameTree::rootOf(const std::string &frame) const {
  const std::vector<const Link *> links = linksOf(frame);
  return links.empty() ? frame : links.back()->parent;
}

// The outermost frame that does not move against this one.
std::string FrameTree::bodyOf(const std::string &frame, sphc_rigid &body_from_frame) const {
  std::string body = frame;
  body_from_frame = kSameFrame;
  for (const Link *link : linksOf(frame)) {
    if (!link->fixed) break;
    body_from_frame = composed(*link->fixed, body_from_frame);
    body = link->parent;
  }
  return body;
}

bool FrameTree::areJoined(const std::string &a, const std::string &b) const {
  return !a.empty() && rootOf(a) == rootOf(b);
}

std::optional<sphc_rigid> FrameTree::fixed(const std::string &target, const std::string &source) const {
  sphc_rigid body_from_target, body_from_source;
  if (target.empty() || source.empty()) return {};
  if (bodyOf(target, body_from_target) != bodyOf(source, body_from_source)) return {};
  return composed(inverted(body_from_target), body_from_source);
}

PoseTrack FrameTree::track(const std::string &frame) const {
  const std::vector<const Link *> links = linksOf(frame);
  const Link *busiest = nullptr;
  for (const Link *link : links)
    if (link->moving.size() > (busiest ? busiest->moving.size() : 0)) busiest = link;
  PoseTrack track;
  if (!busiest || rivals(frame)) return track;
  int64_t last_ns = INT64_MIN;
  for (const TimedPose &sample : busiest->moving) {
    sphc_rigid root_from_frame = kSameFrame;
    bool is_known = sample.time_ns > last_ns;
    for (const Link *link : links) {
      const std::optional<sphc_rigid> step = link->fixed ? link->fixed : link->track.at(sample.time_ns, kMostGapNs);
      is_known = is_known && step;
      if (!is_known) break;
      root_from_frame = composed(*step, root_from_frame);
    }
    if (!is_known) continue;
    track.add(sample.time_ns, root_from_frame);
    last_ns = sample.time_ns;
  }
  return track;
}

std::optional<FrameTree::Rivals> FrameTree::rivals(const std::string &frame) const {
  std::string moved = frame;
  for (const Link *link : linksOf(frame)) {
    if (!link->rival.empty()) return Rivals{moved, link->topic, link->rival};
    moved = link->parent;
  }
  return {};
}

std::string FrameTree::movedApartFrom(const std::string &frame) const {
  const std::string root = rootOf(frame);
  std::string moved;
  size_t most = 0;
  for (const auto &[child, link] : links_) {
    if (link.moving.size() <= most || rootOf(child) == root) continue;
    most = link.moving.size();
    moved = child;
  }
  return moved;
}

}  // namespace sphc::recording
