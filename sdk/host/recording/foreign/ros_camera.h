// The camera that a sensor_msgs/CameraInfo describes.
#pragma once

#include "host/recording/foreign/ros_messages.h"

namespace sphc::recording {

// Of the image as the sensor gave it, or of the rectified one, which has no distortion.  ROS's pixel centres, at 0,
// become those of this library, at 0.5.  Throws Failure (ARGUMENT) without a name.
sphc_camera rosCamera(const RosCameraInfo &info, bool is_rectified);

}  // namespace sphc::recording
