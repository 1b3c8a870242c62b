// Recordings of ROS 2 in MCAP: images, cameras and transforms by topic.
#include <algorithm>

#include "host/recording/calibration_json.h"
#include "host/recording/failure.h"
#include "host/recording/foreign/frame_tree.h"
#include "host/recording/foreign/ros_camera.h"
#include "host/recording/foreign/ros_images.h"
#include "host/recording/foreign/ros_topics.h"
#include "host/recording/recording.h"

namespace sphc::recording {

namespace fs = std::filesystem;

namespace {

struct RosBag {
  RosContent content;
  FrameTree frames;
  std::shared_ptr<const std::vector<BagChunk>> chunks;
  uint32_t bad_chunk_count = 0;
  bool is_cut = false;
};

// The time of the header is that of the measurement; that of the log is when it was written.
int64_t timeOfRos(const RosHeader &header, uint64_t log_ns) {
  return header.time_ns > 0 ? header.time_ns : static_cast<int64_t>(std::min<uint64_t>(log_ns, INT64_MAX));
}

void addImage(const BagMessage &message, bool is_compressed, RosContent *content) {
  RosImage raw = {};
  RosCompressedImage compressed;
  if (is_compressed ? !readRosCompressedImage(message.data, compressed) : !readRosImage(message.data, raw)) return;
  const RosHeader &header = is_compressed ? compressed.header : raw.header;
  RosImageTopic &topic = content->images[message.channel.topic];
  if (topic.images.empty())
    topic = {message.channel.topic,
             std::string(is_compressed ? compressed.format : raw.encoding),
             header.frame,
             is_compressed,
             raw.width,
             raw.height,
             {}};
  topic.images.push_back({timeOfRos(header, message.log_ns), message.place});
}

void addTransforms(const BagMessage &message, bool is_odometry, FrameTree *frames) {
  std::vector<RosTransform> transforms(is_odometry ? 1 : 0);
  if (is_odometry ? !readRosOdometry(message.data, transforms[0]) : !readRosTransforms(message.data, transforms))
    return;
  const std::string &topic = message.channel.topic;
  const bool is_fixed = !is_odometry && topic.size() >= 9 && topic.substr(topic.size() - 9) == "tf_static";
  for (const RosTransform &transform : transforms) {
    if (is_fixed)
      frames->addFixed(transform.header.frame, transform.child, transform.parent_from_child);
    else
      frames->addMoving(transform.header.frame, transform.child,
                        {timeOfRos(transform.header, message.log_ns), transform.parent_from_child});
  }
}

void addMessage(const BagMessage &message, RosBag *bag) {
  const std::string &type = message.channel.type;
  if (!message.channel.is_cdr) return;
  if (type == "sensor_msgs/msg/Image") addImage(message, false, &bag->content);
  if (type == "sensor_msgs/msg/CompressedImage") addImage(message, true, &bag->content);
  if (type == "tf2_msgs/msg/TFMessage") addTransforms(message, false, &bag->frames);
  if (type == "nav_msgs/msg/Odometry") addTransforms(message, true, &bag->frames);
  if (type != "sensor_msgs/msg/CameraInfo" || bag->content.infos.count(message.channel.topic)) return;
  RosCameraInfo info;
  if (readRosCameraInfo(message.data, info)) bag->content.infos[message.channel.topic] = info;
}

RosBag readBag(const fs::path &path) {
  RosBag bag;
  BagFile file(path);
  file.forEachMessage([&bag](const BagMessage &message) { addMessage(message, &bag); });
  bag.frames.sort();
  bag.chunks = file.chunks();
  bag.bad_chunk_count = file.badChunkCount();
  bag.is_cut = file.isCut();
  return bag;
}

class RosImages : public LayoutImages {
 public:
  RosImages(const fs::path &path, std::shared_ptr<const std::vector<BagChunk>> chunks, bool color_is_compressed,
            bool depth_is_compressed)
      : file_(path, std::move(chunks)),
        color_is_compressed_(color_is_compressed),
        depth_is_compressed_(depth_is_compressed) {}

  void read(sphc_stream stream, const RecordedImage &image, const sphc_camera &camera, sphc_format format,
            uint8_t *pixels) override {
    const ByteView message = file_.load({image.place.chunk, image.place.start, image.place.bytes});
    if (stream == SPHC_STREAM_COLOR)
      decodeRosColor(message, color_is_compressed_, camera, format, pixels);
    else
      decodeRosDepth(message, depth_is_compressed_, camera, reinterpret_cast<uint16_t *>(pixels));
  }

 private:
  BagFile file_;
  bool color_is_compressed_, depth_is_compressed_;
};

// In order of time, numbered; of equal times the first counts.
std::vector<RecordedImage> imagesOf(const RosImageTopic &topic, uint64_t *lost_count) {
  std::vector<RosStamped> stamped = topic.images;
  std::stable_sort(stamped.begin(), stamped.end(),
                   [](const RosStamped &a, const RosStamped &b) { return a.time_ns < b.time_ns; });
  std::vector<RecordedImage> images;
  for (const RosStamped &each : stamped) {
    if (!images.empty() && images.back().time_ns == each.time_ns) {
      ++*lost_count;
      continue;
    }
    RecordedImage image = {};
    image.time_ns = each.time_ns;
    image.sequence = static_cast<uint32_t>(images.size());
    image.place = {Kind::kNone, each.place.chunk, each.place.start, each.place.bytes};
    images.push_back(std::move(image));
  }
  return images;
}

sphc_camera cameraOfTopic(const RosContent &content, const RosImageTopic &topic) {
  const RosCameraInfo *info = infoOf(content, topic);
  if (!info)
    throw Failure(SPHC_E_ARGUMENT, "no " + infoTopicOf(topic.name) + "; record it too, or give a calibration file");
  try {
    return rosCamera(*info, topic.name.find("rect") != std::string::npos);
  } catch (const Failure &failure) {
    throw Failure(failure.status(), infoTopicOf(topic.name) + ": " + failure.what());
  }
}

sphc_rig rigOf(const RosBag &bag, const RosImageTopic &color, const RosImageTopic &depth) {
  sphc_rig rig;
  sphc_rig_init(&rig);
  rig.color_camera = cameraOfTopic(bag.content, color);
  rig.depth_camera = cameraOfTopic(bag.content, depth);
  const std::optional<sphc_rigid> color_from_depth = bag.frames.fixed(color.frame, depth.frame);
  if (!color_from_depth)
    throw Failure(SPHC_E_ARGUMENT, "no transform from " + depth.frame + " to " + color.frame +
                                       " in tf_static; record it too, or give a calibration file");
  rig.color_from_depth = *color_from_depth;
  rig.depth_unit_m = 0.001;
  return requireGood(rig);
}

Recording recordingOf(const fs::path &path, const RosBag &bag) {
  const std::string name = shortPath(path.string());
  const RosImageTopic &color = chooseColor(bag.content, name);
  const RosImageTopic &depth = chooseDepth(bag.content, color, name);
  Recording recording;
  recording.layout = Layout::kRos2;
  recording.path = path;
  recording.color = imagesOf(color, &recording.lost_count);
  recording.depth = imagesOf(depth, &recording.lost_count);
  recording.poses = bag.frames.track(color.frame);
  recording.bad_chunk_count = bag.bad_chunk_count;
  recording.is_cut = bag.is_cut;
  recording.images = [path, chunks = bag.chunks, color_is = color.is_compressed, depth_is = depth.is_compressed] {
    return std::make_unique<RosImages>(path, chunks, color_is, depth_is);
  };
  try {
    recording.calibration = rigOf(bag, color, depth);
  } catch (const Failure &failure) {  // told only where nobody gives a calibration file
    recording.calibration_fault = name + ": " + failure.what();
  }
  return recording;
}

// The one file in a folder of `ros2 bag record`.
fs::path fileOfBag(const fs::path &folder) {
  fs::path found;
  const std::string name = shortPath(folder.string());
  for (const fs::directory_entry &entry : fs::directory_iterator(folder)) {
    const std::string ending = entry.path().extension().string();
    if (ending == ".db3" || ending == ".zstd")
      throw Failure(SPHC_E_UNSUPPORTED, name + ": a ROS 2 bag of " + ending +
                                            " files is not read; \"ros2 bag convert\" writes MCAP of it "
                                            "(docs/imports.md)");
    if (ending != ".mcap") continue;
    if (!found.empty())
      throw Failure(SPHC_E_ARGUMENT, name +
                                         ": a ROS 2 bag of several files; give one of them, or make one of them by "
                                         "\"mcap merge\"");
    found = entry.path();
  }
  if (found.empty()) throw Failure(SPHC_E_DEVICE, name + ": a ROS 2 bag without its .mcap file; copy that too");
  return found;
}

}  // namespace

bool isRosBag(const fs::path &folder) { return fs::exists(folder / "metadata.yaml"); }

Recording openRosBag(const fs::path &path) {
  const fs::path file = fs::is_directory(path) ? fileOfBag(path) : path;
  return recordingOf(file, readBag(file));
}

}  // namespace sphc::recording
