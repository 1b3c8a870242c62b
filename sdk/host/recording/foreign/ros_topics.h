// Which topics of a ROS recording are its colour and its depth.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "host/recording/foreign/bag_file.h"
#include "host/recording/foreign/ros_messages.h"
#include "host/recording/recording.h"

namespace sphc::recording {

struct RosStamped {
  int64_t time_ns;
  BagPlace place;
};

// How the images of a topic are written.
struct RosImageCoding {
  RosEncoding encoding;
  bool is_compressed;
};

// A topic of images, by its first message.
struct RosImageTopic {
  std::string name, encoding;  // of the pixels; of a compressed image its format
  std::string frame;
  RosImageCoding coding;
  uint32_t width, height;  // 0 of a compressed image
  std::vector<RosStamped> images;
};

// A topic of inertial data.
struct RosInertialTopic {
  std::string frame;
  std::vector<TimedAcceleration> accelerations;  // in the axes of its frame
};

// What a ROS recording holds that is read.
struct RosContent {
  std::map<std::string, RosImageTopic> images;       // by topic
  std::map<std::string, RosCameraInfo> infos;        // likewise, the first of each
  std::map<std::string, RosInertialTopic> inertial;  // likewise
  std::map<std::string, float> depth_unit_m;         // by sensor, of a RealSense
};

// Throw Failure (ARGUMENT) that begins with `file`, where there is none or where several are as good.
const RosImageTopic &chooseColor(const RosContent &content, const std::string &file);
const RosImageTopic &chooseDepth(const RosContent &content, const RosImageTopic &color, const std::string &file);

// By a word of the topic that begins with "rect", as "image_rect_color" has one and "direct" has none.
bool isOfRectified(const RosImageTopic &topic);

// The camera_info beside a topic of images, or the only one of its frame; null when there is none.
const RosCameraInfo *infoOf(const RosContent &content, const RosImageTopic &topic);
// ".../camera_info", as it should be called.
std::string infoTopicOf(const std::string &image_topic);

}  // namespace sphc::recording
