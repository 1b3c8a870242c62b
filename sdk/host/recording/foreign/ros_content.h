// What a bag of ROS holds that a recording is made of.
#pragma once

#include "host/recording/foreign/bag_walk.h"
#include "host/recording/foreign/frame_tree.h"
#include "host/recording/foreign/ros_topics.h"

namespace sphc::recording {

struct RosBag {
  RosContent content;
  FrameTree frames;
  BagWalk walk;
};

// Reads the whole file, MCAP or a bag of ROS 1.  Throws Failure.
RosBag readRosBag(const std::filesystem::path &path, bool is_ros1);

}  // namespace sphc::recording
