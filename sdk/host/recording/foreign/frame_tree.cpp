#include "host/recording/foreign/frame_tree.h"

#include <algorithm>

namespace sphc::recording {

namespace {

constexpr int64_t kMostGapNs = 1000000000;  // between transforms of a link; drift of a map is told seldom
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

}  // namespace

void FrameTree::addFixed(const std::string &parent, const std::string &child, const sphc_rigid &parent_from_child) {
  Link &link = links_[child];
  if (!link.parent.empty() || parent == child) return;
  link.parent = parent;
  link.fixed = parent_from_child;
}

void FrameTree::addMoving(const std::string &parent, const std::string &child, const TimedPose &parent_from_child) {
  Link &link = links_[child];
  if (link.parent.empty() && parent != child) link.parent = parent;
  if (link.parent == parent && !link.fixed) link.moving.push_back(parent_from_child);
}

void FrameTree::sort() {
  for (auto &[child, link] : links_) {
    std::stable_sort(link.moving.begin(), link.moving.end(),
                     [](const TimedPose &a, const TimedPose &b) { return a.time_ns < b.time_ns; });
    link.track = {};
    for (const TimedPose &pose : link.moving) link.track.add(pose.time_ns, pose.pose);
  }
}

std::vector<const FrameTree::Link *> FrameTree::linksOf(std::string frame) const {
  std::vector<const Link *> links;
  for (auto found = links_.find(frame); found != links_.end() && links.size() < links_.size();
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

std::optional<sphc_rigid> FrameTree::fixed(const std::string &target, const std::string &source) const {
  sphc_rigid body_from_target, body_from_source;
  if (bodyOf(target, body_from_target) != bodyOf(source, body_from_source)) return {};
  return composed(inverted(body_from_target), body_from_source);
}

PoseTrack FrameTree::track(const std::string &frame) const {
  const std::vector<const Link *> links = linksOf(frame);
  const Link *busiest = nullptr;
  for (const Link *link : links)
    if (link->moving.size() > (busiest ? busiest->moving.size() : 0)) busiest = link;
  PoseTrack track;
  if (!busiest) return track;
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
