// Recordings of ROS, in MCAP or a bag of ROS 1: images, cameras and transforms by topic.
#include "host/recording/calibration_json.h"
#include "host/recording/failure.h"
#include "host/recording/file_reader.h"
#include "host/recording/foreign/realsense_topics.h"
#include "host/recording/foreign/ros_camera.h"
#include "host/recording/foreign/ros_content.h"
#include "host/recording/foreign/ros_images.h"
#include "host/recording/foreign/time_order.h"
#include "host/recording/recording.h"

namespace sphc::recording {

namespace fs = std::filesystem;

namespace {

class RosImages : public LayoutImages {
 public:
  RosImages(const fs::path &path, std::shared_ptr<const BagChunks> chunks, RosImageCoding color,
            RosImageCoding depth)
      : file_(path, std::move(chunks)), color_(color), depth_(depth) {}

  void read(sphc_stream stream, const RecordedImage &image, const sphc_camera &camera, sphc_format format,
            uint8_t *pixels) override {
    const ByteView bytes = file_.load({image.place.chunk, image.place.start, image.place.bytes});
    if (stream == SPHC_STREAM_COLOR)
      decodeRosColor({bytes, color_.encoding}, color_.is_compressed, camera, format, pixels);
    else
      decodeRosDepth({bytes, depth_.encoding}, depth_.is_compressed, camera, reinterpret_cast<uint16_t *>(pixels));
  }

 private:
  BagFile file_;
  RosImageCoding color_, depth_;
};

// Empty where times grow, as they do where one clock tells them.
std::string orderFaultOf(const RosImageTopic &topic) {
  uint32_t backward_count = 0;
  size_t first = 0;
  for (size_t i = 1; i < topic.images.size(); ++i)
    if (topic.images[i].time_ns < topic.images[i - 1].time_ns && ++backward_count == 1) first = i;
  if (backward_count == 0) return "";
  const int64_t by_ns = topic.images[first - 1].time_ns - topic.images[first].time_ns;
  return "the times of " + topic.name + " go back " +
         (backward_count == 1 ? "once" : std::to_string(backward_count) + " times") + ", first at image " +
         std::to_string(first) + " (from 0, as they lie in the file) by " + std::to_string(by_ns / 1000000) +
         " ms; images were put in order of time. If a clock was set back while it recorded, images of two moments "
         "are mixed now: record it again with a clock that only goes forwards";
}

std::vector<RecordedImage> imagesOf(const RosImageTopic &topic, Recording *recording) {
  const std::string order_fault = orderFaultOf(topic);
  if (!order_fault.empty()) recording->order_faults.push_back(order_fault);
  std::vector<RecordedImage> images;
  images.reserve(topic.images.size());
  for (const RosStamped &stamped : topic.images) {
    RecordedImage image = {};
    image.time_ns = stamped.time_ns;
    image.place = {Kind::kNone, stamped.place.chunk, stamped.place.start, stamped.place.bytes};
    images.push_back(std::move(image));
  }
  return inOrderOfTime(std::move(images), recording);
}

std::string sizeText(uint32_t width, uint32_t height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

// A compressed image of which no decoder knows the size is told of when it is read.
void requireSizeOf(const RosImageTopic &topic, const sphc_camera &camera) {
  if (topic.width == 0 || (camera.width == topic.width && camera.height == topic.height)) return;
  throw Failure(SPHC_E_ARGUMENT, "is of images of " + sizeText(camera.width, camera.height) + ", and those of " +
                                     topic.name + " are " + sizeText(topic.width, topic.height) +
                                     "; record the camera_info of these images, or give a calibration file");
}

sphc_camera cameraOfTopic(const RosContent &content, const RosImageTopic &topic) {
  const RosCameraInfo *info = infoOf(content, topic);
  if (!info)
    throw Failure(SPHC_E_ARGUMENT, "no " + infoTopicOf(topic.name) + "; record it too, or give a calibration file");
  try {
    const sphc_camera camera = rosCamera(*info, isOfRectified(topic));
    requireSizeOf(topic, camera);
    return camera;
  } catch (const Failure &failure) {
    throw Failure(failure.status(), infoTopicOf(topic.name) + ": " + failure.what());
  }
}

std::string whyApart(const FrameTree &frames, const RosImageTopic &color, const RosImageTopic &depth) {
  for (const RosImageTopic *topic : {&color, &depth})
    if (topic->frame.empty())
      return "the images of " + topic->name +
             " name no frame (header.frame_id), so nothing tells where depth lies on colour; record them with "
             "one, or give a calibration file";
  if (frames.areJoined(depth.frame, color.frame))
    return depth.frame + " and " + color.frame + " are joined only by what moves on /tf; give a calibration file";
  return "no transform from " + depth.frame + " to " + color.frame +
         " in tf_static; record it too, or give a calibration file";
}

sphc_rig rigOf(const RosBag &bag, const RosImageTopic &color, const RosImageTopic &depth) {
  sphc_rig rig;
  sphc_rig_init(&rig);
  rig.color_camera = cameraOfTopic(bag.content, color);
  rig.depth_camera = cameraOfTopic(bag.content, depth);
  const std::optional<sphc_rigid> color_from_depth = bag.frames.fixed(color.frame, depth.frame);
  if (!color_from_depth) throw Failure(SPHC_E_ARGUMENT, whyApart(bag.frames, color, depth));
  rig.color_from_depth = *color_from_depth;
  const auto unit = bag.content.depth_unit_m.find(realsenseSensorOf(depth.name));
  rig.depth_unit_m = unit == bag.content.depth_unit_m.end() ? 0.001 : static_cast<double>(unit->second);
  return requireGood(rig);
}

// Of the inertial sensor that says most and stands still against the camera.
std::vector<TimedAcceleration> accelerationsOf(const RosBag &bag, const std::string &color_frame) {
  std::vector<TimedAcceleration> chosen;
  for (const auto &[name, topic] : bag.content.inertial) {
    const std::optional<sphc_rigid> color_from_sensor = bag.frames.fixed(color_frame, topic.frame);
    if (!color_from_sensor || topic.accelerations.size() <= chosen.size()) continue;
    chosen = topic.accelerations;
    turnAccelerations(*color_from_sensor, &chosen);
  }
  return inOrderOfTime(std::move(chosen));
}

// Why nothing tells where the camera was, though something moves; empty where nothing is to be said.
std::string poseFaultOf(const FrameTree &frames, const std::string &color_frame) {
  if (const std::optional<FrameTree::Rivals> rivals = frames.rivals(color_frame))
    return "it has no poses: both " + rivals->topic + " and " + rivals->other + " may tell where " + rivals->frame +
           " was; leave one out (docs/imports.md says how), or take spherecloud map";
  const std::optional<FrameTree::Useless> &useless = frames.useless();
  if (useless)
    return "it has no poses: " + useless->topic + " tells where \"" + useless->child + "\" was in \"" +
           useless->parent +
           "\", and one has no name, or both are of one body; record it with two names in child_frame_id and "
           "header.frame_id, or take spherecloud map";
  const std::string moved = frames.movedApartFrom(color_frame);
  if (moved.empty()) return "";
  if (color_frame.empty())
    return "it has no poses: odometry or tf moves " + moved +
           ", and the colour images name no frame (header.frame_id); record them with one, or take spherecloud map";
  return "it has no poses: odometry or tf moves " + moved + ", and no transform joins that to " + color_frame +
         ", the colour camera's frame; record /tf_static with it, or take spherecloud map";
}

Recording recordingOf(const fs::path &path, Layout layout, const RosBag &bag) {
  const std::string name = shortPath(path.string());
  const RosImageTopic &color = chooseColor(bag.content, name);
  const RosImageTopic &depth = chooseDepth(bag.content, color, name);
  Recording recording;
  recording.layout = layout;
  recording.path = path;
  recording.color = imagesOf(color, &recording);
  recording.depth = imagesOf(depth, &recording);
  recording.poses = bag.frames.track(color.frame);
  if (recording.poses.poses().empty()) recording.pose_fault = poseFaultOf(bag.frames, color.frame);
  recording.accelerations = accelerationsOf(bag, color.frame);
  recording.bad_chunk_count = bag.walk.bad_chunk_count;
  recording.is_cut = bag.walk.is_cut;
  recording.images = [path, chunks = std::make_shared<const BagChunks>(bag.walk.chunks),
                      color_coding = color.coding, depth_coding = depth.coding] {
    return std::make_unique<RosImages>(path, chunks, color_coding, depth_coding);
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
  return recordingOf(file, Layout::kRos2, readRosBag(file, false));
}

bool isRos1Bag(const fs::path &file) { return beginsWith(file, kRos1Magic); }

Recording openRos1Bag(const fs::path &file) { return recordingOf(file, Layout::kRos1, readRosBag(file, true)); }

}  // namespace sphc::recording
