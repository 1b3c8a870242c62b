// The tree of coordinate frames that ROS's transforms make: which frame hangs in which, when and where.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "host/recording/pose_track.h"

namespace sphc::recording {

class FrameTree {
 public:
  // Who tells where a frame moves: a topic of transforms, or one of odometry.
  struct Teller {
    std::string topic;
    bool is_odometry;
  };
  // A frame has one parent: the first that it is told to be fixed to, or else one that it moves against.
  void addFixed(const std::string &parent, const std::string &child, const sphc_rigid &parent_from_child);
  void addMoving(const Teller &teller, const std::string &parent, const std::string &child,
                 const TimedPose &parent_from_child);
  // What is told of a frame counts for all that is fixed to it.  Of those who tell of one body, transforms come
  // before odometry, then the first that told.  Transforms that never change are fixed, but where odometry tells of
  // that frame.  To be called when all is added.
  void resolve();

  // Between frames of one body; none where something moves between them, or nothing joins them.  Two frames without
  // a name are not one frame.
  std::optional<sphc_rigid> fixed(const std::string &target, const std::string &source) const;
  // By anything, fixed or moving.
  bool areJoined(const std::string &a, const std::string &b) const;
  // root_from_frame of the outermost frame, at every time of the transform on the way that is told most often;
  // empty where nothing on the way moves, or rivals tell of it.
  PoseTrack track(const std::string &frame) const;
  // Two topics that tell where a frame moves and are as good as each other.
  struct Rivals {
    std::string frame, topic, other;
  };
  // On the way from this frame outwards.
  std::optional<Rivals> rivals(const std::string &frame) const;
  // Odometry of a frame without a name, or that moves nothing: its frames belong to one body.
  struct Useless {
    std::string topic, parent, child;
  };
  const std::optional<Useless> &useless() const { return useless_; }
  // Of what moves and is joined to this frame by nothing the one that is told of most often; empty where there is
  // none.
  std::string movedApartFrom(const std::string &frame) const;

 private:
  // What one teller says of one frame and its parent.
  struct Claim {
    Teller teller;
    std::string parent, child;
    std::vector<TimedPose> samples;
  };
  // Transforms of a body's outermost frame, which is the only one that they can tell of without a contradiction, of
  // another one, and odometry.
  enum class Rank { kTransforms, kTransformsOfAPart, kOdometry };
  struct Link {
    std::string parent;
    std::optional<sphc_rigid> fixed;
    std::vector<TimedPose> moving;  // in order of time
    PoseTrack track;                // of `moving`
    Rank rank{};                    // of who tells of `moving`
    std::string topic;              // likewise
    std::string rival;              // another topic of this rank
  };
  bool isStill(const Claim &claim) const;
  Rank rankOf(const Claim &claim) const;
  void hang(Rank rank, Claim *claim);
  // A frame's links outwards, up to the root or as many as a tree can have.
  std::vector<const Link *> linksOf(std::string frame) const;
  std::string rootOf(const std::string &frame) const;
  std::string bodyOf(const std::string &frame, sphc_rigid &body_from_frame) const;

  std::map<std::string, Link> links_;                            // by the child
  std::vector<Claim> claims_;                                    // in the order in which they begin
  std::map<std::array<std::string, 3>, size_t> claim_by_names_;  // topic, parent, child
  std::set<std::string> odometry_;                               // frames that it tells of
  std::optional<Useless> useless_;                               // the first
};

}  // namespace sphc::recording
