// ROS's own messages, as far as a recording needs them.
#pragma once

#include <spherecloud/spherecloud.h>

#include <string>
#include <vector>

#include "host/recording/foreign/ros_reader.h"

namespace sphc::recording {

struct RosHeader {
  int64_t time_ns;  // 0: not told
  std::string frame;
};

// Views of what a message holds.
struct RosImage {
  RosHeader header;
  uint32_t width, height, step;
  std::string_view encoding;
  ByteView data;
};
struct RosCompressedImage {
  RosHeader header;
  std::string_view format;
  ByteView data;
};

struct RosCameraInfo {
  RosHeader header;
  uint32_t width, height;
  std::string distortion_model;
  std::vector<double> d;
  double k[9], p[12];
  uint32_t binning, offset;  // the greater of x and y; pixels of the sensor
};

// x in `frame` of the header is `pose` of x in `child`.
struct RosTransform {
  RosHeader header;
  std::string child;
  sphc_rigid parent_from_child;
};

struct RosAcceleration {
  RosHeader header;
  double felt_mps2[3];
};

// False when malformed, of big-endian bytes, or a transform's numbers are none.
bool readRosImage(const RosMessage &message, RosImage &image);
bool readRosCompressedImage(const RosMessage &message, RosCompressedImage &image);
bool readRosCameraInfo(const RosMessage &message, RosCameraInfo &info);
// tf2_msgs/TFMessage; those that are malformed are left out.
bool readRosTransforms(const RosMessage &message, std::vector<RosTransform> &transforms);
// nav_msgs/Odometry: its pose.
bool readRosOdometry(const RosMessage &message, RosTransform &transform);
// sensor_msgs/Imu: its acceleration.  False too where it says that it has none, or is a gyroscope's alone.
bool readRosAcceleration(const RosMessage &message, RosAcceleration &acceleration);
// geometry_msgs/Transform: parent_from_child of frames that it does not name.
bool readRosRigid(const RosMessage &message, sphc_rigid &rigid);

}  // namespace sphc::recording
