// What other programs recorded, as far as its bytes are read here.
#include <cmath>
#include <string_view>

#include "host/recording/failure.h"
#include "host/recording/foreign/record3d_metadata.h"
#include "host/recording/foreign/stray_text.h"
#include "tests/fuzz/recording_seeds.h"
#include "tests/fuzz/targets.h"
#include "tests/support/ros_bag.h"

namespace sphc::fuzz {

void stray(const uint8_t *data, size_t bytes) {
  if (bytes == 0) return;
  const std::vector<char> exact(data + 1, data + bytes);  // so that a sanitizer sees a step too far
  const std::string_view text(exact.data(), exact.size());
  try {
    if (data[0] % 2) {
      recording::strayCameraFrom(text);
      return;
    }
    const recording::StrayOdometry odometry = recording::strayOdometryFrom(text);
    for (size_t i = 0; i < odometry.frames.size(); ++i) {
      const recording::StrayFrame &frame = odometry.frames[i];
      if (i > 0 && frame.time_ns <= odometry.frames[i - 1].time_ns) broken("times increase");
      if (frame.world_from_camera && !std::isfinite(frame.world_from_camera->t_m[0])) broken("poses are finite");
    }
  } catch (const recording::Failure &failure) {
    if (failure.status() != SPHC_E_ARGUMENT) broken("the failure is the text's");
  }
}

void ros2(const uint8_t *data, size_t bytes) { recording(data, bytes); }

std::vector<std::vector<uint8_t>> ros2Seeds() {
  constexpr uint32_t kSide = 16;
  test::RosBag bag;
  const std::string type = "sensor_msgs/msg/";
  const sphc_rigid same = {{1, 0, 0, 0}, {0, 0, 0}};
  for (const char *name : {"color", "depth"})
    bag.add("/" + std::string(name) + "/camera_info", type + "CameraInfo", 5,
            test::rosCameraInfo(name, kSide, kSide, "plumb_bob", {0.1, 0, 0, 0}, {20, 20, 7.5, 7.5}));
  bag.add("/tf_static", "tf2_msgs/msg/TFMessage", 5,
          test::rosTransforms(5, {{"base", "color", same}, {"color", "depth", same}}));
  for (int64_t i = 1; i < 3; ++i) {
    const int64_t time_ns = 1000000000 * i;
    const recording::Bytes color(kSide * kSide * 3, 77), depth(kSide * kSide * (i == 1 ? 2 : 4), 60);
    bag.add("/color/image_raw", type + "Image", 5, test::rosImage(time_ns, "color", kSide, kSide, "rgb8", color));
    bag.add("/depth/image_raw", type + "Image", 5,
            test::rosImage(time_ns, "depth", kSide, kSide, i == 1 ? "16UC1" : "32FC1", depth));
    bag.add("/odom", "nav_msgs/msg/Odometry", 5, test::rosOdometry(time_ns, {"odom", "base", same}));
    bag.add("/tf", "tf2_msgs/msg/TFMessage", 5, test::rosTransforms(time_ns, {{"map", "odom", same}}));
  }
  const std::string plain = bag.bytes(test::RosBag::Chunks::kNone),
                    stored = bag.bytes(test::RosBag::Chunks::kStored),
                    packed = bag.bytes(test::RosBag::Chunks::kZstd);
  return {{plain.begin(), plain.end()}, {stored.begin(), stored.end()}, {packed.begin(), packed.end()}};
}

void record3d(const uint8_t *data, size_t bytes) {
  const std::vector<char> exact(data, data + bytes);
  try {
    const recording::Record3dMetadata metadata =
        recording::record3dMetadataFrom(std::string_view(exact.data(), exact.size()));
    if (metadata.time_ns.size() != metadata.world_from_camera.size())
      broken("a frame has a time and an entry of poses");
    for (size_t i = 1; i < metadata.time_ns.size(); ++i)
      if (metadata.time_ns[i] <= metadata.time_ns[i - 1]) broken("times increase");
  } catch (const recording::Failure &failure) {
    if (failure.status() != SPHC_E_ARGUMENT) broken("the failure is the text's");
  }
}

std::vector<std::vector<uint8_t>> record3dSeeds() {
  const std::string text = R"({"w": 720, "h": 960, "fps": 60, "K": [688, 0, 0, 0, 688, 0, 360, 481, 1], )"
                           R"("poses": [[0, 0, 0, 1, 0, 0, 0], [0.1, 0, 0, 0.99, 0, 0, 1]])";
  const std::string more =
      R"(, "frameTimestamps": [1.5, 2], "perFrameIntrinsicCoeffs": [[1, 2, 3, 4], [5, 6, 7, 8]]})";
  const std::string old = text + "}", all = text + more;
  return {{old.begin(), old.end()}, {all.begin(), all.end()}};
}

std::vector<std::vector<uint8_t>> straySeeds() {
  const std::string odometry =
      "0timestamp, frame, x, y, z, qx, qy, qz, qw, fx, fy, cx, cy\n"
      "100.016, 000001, 0.1, 1, 2, 0.7, 0, 0, 0.7, 1400, 1400, 960.5, 720\n"
      "100.032, 000002, 0.2, 1, 2, 0.7, 0, 0, 0.7, 1402, 1402, 960.5, 721\n";
  const std::string camera = "11400.0, 0.0, 960.0\n0.0, 1400.0, 720.0\n0.0, 0.0, 1.0\n";
  return {{odometry.begin(), odometry.end()}, {camera.begin(), camera.end()}};
}

}  // namespace sphc::fuzz
