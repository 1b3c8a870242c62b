#include "host/recording/foreign/realsense_topics.h"

#include <cstring>

namespace sphc::recording {

namespace {

// The first so many names of a topic; empty where it has fewer or is of another kind.
std::string firstNames(const std::string &topic, int count) {
  if (topic.rfind("/device_", 0) != 0 || topic.find("/sensor_") == std::string::npos) return "";
  size_t end = 0;
  for (; count > 0 && end != std::string::npos; --count) end = topic.find('/', end + 1);
  return end == std::string::npos ? "" : topic.substr(0, end);
}

}  // namespace

std::string realsenseStreamOf(const std::string &topic) { return firstNames(topic, 3); }
std::string realsenseSensorOf(const std::string &topic) { return firstNames(topic, 2); }

std::string realsenseReferenceOf(const std::string &topic) {
  const std::string stream = realsenseStreamOf(topic);
  if (stream.empty() || topic.compare(stream.size(), strlen("/tf/"), "/tf/") != 0) return "";
  return firstNames(topic, 1) + topic.substr(stream.size());
}

bool isRealsenseDepthUnit(const std::string &topic) {
  const std::string sensor = realsenseSensorOf(topic);
  return !sensor.empty() && topic.substr(sensor.size()) == "/option/Depth_Units/value";
}

}  // namespace sphc::recording
