// Topics of the recordings that a RealSense's own software makes: /device_0/sensor_1/Color_0/image/data and so on.
#pragma once

#include <string>

namespace sphc::recording {

// The stream that a topic is of, "/device_0/sensor_1/Color_0", or of an option the sensor; empty for topics of
// others.
std::string realsenseStreamOf(const std::string &topic);
std::string realsenseSensorOf(const std::string &topic);

// What the transform of such a topic is relative to, "/device_0/tf/0"; empty where it is no transform.
std::string realsenseReferenceOf(const std::string &topic);

// Whether its Float32 is how many metres a unit of depth is.
bool isRealsenseDepthUnit(const std::string &topic);

}  // namespace sphc::recording
