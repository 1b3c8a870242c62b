#include "host/recording/foreign/ros_topics.h"

#include <algorithm>
#include <cctype>
#include <functional>

#include "host/recording/failure.h"
#include "host/recording/foreign/realsense_topics.h"
#include "host/recording/foreign/ros_images.h"

namespace sphc::recording {

namespace {

constexpr size_t kMostOfEncoding = 24;  // shown

bool has(const std::string &text, const char *part) {
  std::string lower = text;
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return lower.find(part) != std::string::npos;
}

bool isInfrared(const RosImageTopic &topic) { return has(topic.name, "infra") || has(topic.name, "/ir/"); }

// By 16UC1, or by mono16 where the topic's name says so.
bool isDepthTopic(const RosImageTopic &topic) {
  if (isInfrared(topic)) return false;
  if (isCompressedDepth(topic.encoding)) return true;
  const bool is_deep = isRos16Bit(topic.encoding) && (topic.encoding[0] == '1' || has(topic.name, "depth"));
  if (topic.coding.is_compressed) return is_deep && has(topic.encoding, "png");
  return is_deep || topic.encoding == "32FC1";
}

bool isGrey(const RosImageTopic &topic) { return topic.encoding == "mono8" || topic.encoding == "8UC1"; }

// Depth of 8 bits is a picture of it, to look at; grey images of a camera with depth in its name are that too.
bool isPictureOfDepth(const RosImageTopic &topic) {
  return !isInfrared(topic) && (has(topic.name, "/depth/") || (isGrey(topic) && has(topic.name, "depth")));
}

// 0: none.  What is called colour comes first, then what has colours; raw images before the same ones compressed.
int colorScore(const RosImageTopic &topic) {
  if (isDepthTopic(topic) || isPictureOfDepth(topic) || topic.images.empty()) return 0;
  const bool is_read = topic.coding.is_compressed ? !isRos16Bit(topic.encoding) : isReadRosColor(topic.encoding);
  if (!is_read) return 0;
  return 1 + (topic.coding.is_compressed ? 0 : 1) + (isGrey(topic) ? 0 : 2) + (isInfrared(topic) ? 0 : 4) +
         (has(topic.name, "color") || has(topic.name, "rgb") ? 8 : 0);
}

// Depth that lies on colour comes first; raw images before the same ones compressed, compressedDepth before PNG.
int depthScore(const RosImageTopic &topic, const RosImageTopic &color) {
  if (!isDepthTopic(topic) || topic.images.empty()) return 0;
  const int of_transport = !topic.coding.is_compressed ? 2 : isCompressedDepth(topic.encoding) ? 1 : 0;
  return 1 + of_transport + (isOfRectified(topic) ? 3 : 0) +
         (!color.frame.empty() && topic.frame == color.frame ? 6 : 0);
}

const RosImageTopic &chooseTopic(const RosContent &content, const char *what, const char *cure,
                                 const std::string &file, const std::function<int(const RosImageTopic &)> &score) {
  const RosImageTopic *best = nullptr, *other = nullptr;
  int highest = 0;
  std::string topics;
  for (const auto &[name, topic] : content.images) {
    topics += (topics.empty() ? "" : ", ") + name + " of " + topic.encoding.substr(0, kMostOfEncoding);
    if (score(topic) < std::max(highest, 1)) continue;
    other = score(topic) == highest ? best : nullptr;
    best = &topic;
    highest = score(topic);
  }
  if (!best)
    throw Failure(SPHC_E_ARGUMENT, file + ": holds no " + what + " image that is read (topics of images: " +
                                       (topics.empty() ? "none" : shortPath(topics)) + "); " + cure +
                                       " (docs/imports.md)");
  if (other)
    throw Failure(SPHC_E_ARGUMENT, file + ": both " + other->name + " and " + best->name + " may be the " + what +
                                       " images; leave one out (docs/imports.md says how)");
  return *best;
}

std::string parentOf(const std::string &topic) { return topic.substr(0, topic.rfind('/')); }

}  // namespace

const RosImageTopic &chooseColor(const RosContent &content, const std::string &file) {
  return chooseTopic(content, "colour", kReadRosColor, file, colorScore);
}

const RosImageTopic &chooseDepth(const RosContent &content, const RosImageTopic &color, const std::string &file) {
  return chooseTopic(content, "depth", kReadRosDepth, file,
                     [&](const RosImageTopic &topic) { return depthScore(topic, color); });
}

bool isOfRectified(const RosImageTopic &topic) {
  const std::string &name = topic.name;
  for (size_t at = name.find("rect"); at != std::string::npos; at = name.find("rect", at + 1))
    if (at == 0 || !std::isalpha(static_cast<unsigned char>(name[at - 1]))) return true;
  return false;
}

std::string infoTopicOf(const std::string &image_topic) {
  const std::string stream = realsenseStreamOf(image_topic);
  if (!stream.empty()) return stream + "/info/camera_info";
  const std::string last = image_topic.substr(image_topic.rfind('/') + 1);
  const bool is_transport = last == "compressed" || last == "compressedDepth";
  return parentOf(is_transport ? parentOf(image_topic) : image_topic) + "/camera_info";
}

const RosCameraInfo *infoOf(const RosContent &content, const RosImageTopic &topic) {
  const auto beside = content.infos.find(infoTopicOf(topic.name));
  if (beside != content.infos.end()) return &beside->second;
  const RosCameraInfo *only = nullptr;
  for (const auto &[name, info] : content.infos) {
    if (info.header.frame != topic.frame) continue;
    if (only) return nullptr;
    only = &info;
  }
  return only;
}

}  // namespace sphc::recording
