#include "host/recording/foreign/ros_content.h"

#include <algorithm>

#include "host/recording/foreign/realsense_topics.h"
#include "host/recording/foreign/ros_images.h"
#include "host/recording/foreign/ros_messages.h"

namespace sphc::recording {

namespace {

// The time of the header is that of the measurement; that of the log is when it was written.
int64_t timeOfRos(const RosHeader &header, uint64_t log_ns) {
  return header.time_ns > 0 ? header.time_ns : static_cast<int64_t>(std::min<uint64_t>(log_ns, INT64_MAX));
}

RosMessage contentOf(const BagMessage &message) { return {message.data, message.channel.encoding}; }

// A RealSense's images name no frame; each stream is one.
std::string frameOf(const std::string &topic, const RosHeader &header) {
  const std::string stream = realsenseStreamOf(topic);
  return stream.empty() ? header.frame : stream;
}

void addImage(const BagMessage &message, bool is_compressed, RosContent *content) {
  RosImage raw = {};
  RosCompressedImage compressed;
  if (is_compressed ? !readRosCompressedImage(contentOf(message), compressed)
                    : !readRosImage(contentOf(message), raw))
    return;
  const RosHeader &header = is_compressed ? compressed.header : raw.header;
  RosImageTopic &topic = content->images[message.channel.topic];
  if (topic.images.empty()) {
    const ImageSize size = is_compressed ? rosImageSize(compressed) : ImageSize{raw.width, raw.height};
    topic = {message.channel.topic,
             std::string(is_compressed ? compressed.format : raw.encoding),
             frameOf(message.channel.topic, header),
             {message.channel.encoding, is_compressed},
             size.width,
             size.height,
             {}};
  }
  topic.images.push_back({timeOfRos(header, message.log_ns), message.place});
}

void addTransforms(const BagMessage &message, bool is_odometry, FrameTree *frames) {
  std::vector<RosTransform> transforms(is_odometry ? 1 : 0);
  if (is_odometry ? !readRosOdometry(contentOf(message), transforms[0])
                  : !readRosTransforms(contentOf(message), transforms))
    return;
  const std::string &topic = message.channel.topic;
  const bool is_fixed = !is_odometry && topic.size() >= 9 && topic.substr(topic.size() - 9) == "tf_static";
  for (const RosTransform &transform : transforms) {
    if (is_fixed)
      frames->addFixed(transform.header.frame, transform.child, transform.parent_from_child);
    else
      frames->addMoving({topic, is_odometry}, transform.header.frame, transform.child,
                        {timeOfRos(transform.header, message.log_ns), transform.parent_from_child});
  }
}

void addInfo(const BagMessage &message, RosContent *content) {
  const std::string &topic = message.channel.topic;
  RosCameraInfo info;
  if (content->infos.count(topic) || !readRosCameraInfo(contentOf(message), info)) return;
  info.header.frame = frameOf(topic, info.header);
  content->infos[topic] = info;
}

// A RealSense tells where its stream is by the topic alone: stream_from_reference.
void addRealsenseTransform(const BagMessage &message, FrameTree *frames) {
  const std::string reference = realsenseReferenceOf(message.channel.topic);
  sphc_rigid stream_from_reference, reference_from_stream;
  if (reference.empty() || !readRosRigid(contentOf(message), stream_from_reference)) return;
  sphc_rigid_inverse(&stream_from_reference, &reference_from_stream);
  frames->addFixed(reference, realsenseStreamOf(message.channel.topic), reference_from_stream);
}

void addAcceleration(const BagMessage &message, RosContent *content) {
  RosAcceleration felt;
  if (!readRosAcceleration(contentOf(message), felt)) return;
  RosInertialTopic &topic = content->inertial[message.channel.topic];
  if (topic.accelerations.empty()) topic.frame = frameOf(message.channel.topic, felt.header);
  const double *a = felt.felt_mps2;
  topic.accelerations.push_back({timeOfRos(felt.header, message.log_ns), {a[0], a[1], a[2]}});
}

void addOption(const BagMessage &message, RosContent *content) {
  if (!isRealsenseDepthUnit(message.channel.topic)) return;
  RosReader reader(contentOf(message));
  const float unit_m = reader.takeFloat();
  if (reader.ok()) content->depth_unit_m.emplace(realsenseSensorOf(message.channel.topic), unit_m);
}

void addMessage(const BagMessage &message, RosBag *bag) {
  const std::string &type = message.channel.type;
  if (message.channel.encoding == RosEncoding::kOther) return;
  if (type == "sensor_msgs/Image") addImage(message, false, &bag->content);
  if (type == "sensor_msgs/CompressedImage") addImage(message, true, &bag->content);
  if (type == "sensor_msgs/CameraInfo") addInfo(message, &bag->content);
  if (type == "tf2_msgs/TFMessage" || type == "tf/tfMessage") addTransforms(message, false, &bag->frames);
  if (type == "nav_msgs/Odometry") addTransforms(message, true, &bag->frames);
  if (type == "geometry_msgs/Transform") addRealsenseTransform(message, &bag->frames);
  if (type == "sensor_msgs/Imu") addAcceleration(message, &bag->content);
  if (type == "std_msgs/Float32") addOption(message, &bag->content);
}

}  // namespace

RosBag readRosBag(const std::filesystem::path &path, bool is_ros1) {
  RosBag bag;
  BagFile file(path);
  const BagVisitor visit = [&bag](const BagMessage &message) { addMessage(message, &bag); };
  bag.walk = is_ros1 ? walkRos1Bag(file, visit) : walkMcapBag(file, visit);
  bag.frames.resolve();
  return bag;
}

}  // namespace sphc::recording
