// The tree of coordinate frames that ROS's transforms make: which frame hangs in which, when and where.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/recording/pose_track.h"

namespace sphc::recording {

class FrameTree {
 public:
  // A frame has one parent: the first that was told.
  void addFixed(const std::string &parent, const std::string &child, const sphc_rigid &parent_from_child);
  void addMoving(const std::string &parent, const std::string &child, const TimedPose &parent_from_child);
  // Brings what moves into its order of time; to be called when all is added.
  void sort();

  // Between frames of one body; none where something moves between them, or nothing joins them.
  std::optional<sphc_rigid> fixed(const std::string &target, const std::string &source) const;
  // root_from_frame of the outermost frame, at every time of the transform on the way that is told most often;
  // empty where nothing on the way moves.
  PoseTrack track(const std::string &frame) const;
  // Of what moves and is joined to this frame by nothing the one that is told of most often; empty where there is
  // none.
  std::string movedApartFrom(const std::string &frame) const;

 private:
  struct Link {
    std::string parent;
    std::optional<sphc_rigid> fixed;
    std::vector<TimedPose> moving;
    PoseTrack track;  // of `moving`, once sorted
  };
  // A frame's links outwards, up to the root; a ring ends where it begins again.
  std::vector<const Link *> linksOf(std::string frame) const;
  std::string rootOf(const std::string &frame) const;
  std::string bodyOf(const std::string &frame, sphc_rigid &body_from_frame) const;

  std::map<std::string, Link> links_;  // by the child
};

}  // namespace sphc::recording
