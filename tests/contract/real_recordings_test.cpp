// Real recordings, which are not part of this project: $SPHC_DATA, or ../shared/data beside the source folder.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/support/temp_folder.h"
#include "tiny_recording.h"

namespace sphc::contract {

namespace {

namespace fs = std::filesystem;

fs::path dataFolder() {
  const char *given = std::getenv("SPHC_DATA");
  return given ? fs::path(given) : fs::path(SPHC_SOURCE_DIR) / ".." / "shared" / "data";
}

bool mustBeThere() {
  const char *required = std::getenv("SPHC_REQUIRE_DATA");
  return required && *required && std::string(required) != "0";
}

// Skips the test when the recording is not there, unless SPHC_REQUIRE_DATA says that it must be.
#define FIND_RECORDING(folder, name)                                                   \
  const fs::path folder = dataFolder() / (name);                                       \
  if (!fs::is_directory(folder) && mustBeThere()) FAIL() << folder << " is not there"; \
  if (!fs::is_directory(folder)) GTEST_SKIP() << folder << " is not there; set SPHC_DATA to run this test"

// R row by row, of a unit quaternion.
void expectRotation(const double q[4], const double (&expected)[9]) {
  const double w = q[0];
  const double x = q[1];
  const double y = q[2];
  const double z = q[3];
  const double rotation[9] = {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
                              2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                              2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(rotation[i], expected[i], 1e-6) << i;
}

// Most of a ToF image holds measurements of a room.
double shareInRoom(const sphc_image &depth) {
  uint32_t count = 0;
  for (uint32_t y = 0; y < depth.height; ++y) {
    const auto *row = reinterpret_cast<const uint16_t *>(static_cast<const uint8_t *>(depth.data) +
                                                         size_t{y} * depth.stride_bytes);
    for (uint32_t x = 0; x < depth.width; ++x) count += row[x] > 300 && row[x] < 10000;
  }
  return static_cast<double>(count) / (depth.width * depth.height);
}

uint32_t countCaptures(const OpenReplay &replay) {
  sphc_source source;
  EXPECT_EQ(sphc_replay_source(replay.get(), &source), SPHC_OK);
  EXPECT_EQ(source.start(source.self), SPHC_OK);
  uint32_t count = 0;
  int64_t last_ns = INT64_MIN;
  sphc_capture capture = {};
  capture.struct_size = sizeof capture;
  while (source.acquire(source.self, 0, &capture) == SPHC_OK) {
    EXPECT_GE(capture.time_ns, last_ns);
    last_ns = capture.time_ns;
    source.release(source.self, &capture);
    ++count;
  }
  EXPECT_STREQ(source.message(source.self), "");
  return count;
}

constexpr const char *kKinect = R"({"format": "spherecloud-calibration", "version": 1, "pixel_center": 0.5,
  "color_camera": {"model": "pinhole", "width": 640, "height": 480, "params": [525.505, 525.505, 320, 240]},
  "depth_camera": {"model": "pinhole", "width": 640, "height": 480, "params": [579.751, 579.751, 317.152, 241.145]},
  "color_from_depth": {"q_wxyz": [0.999981324, 0.002676102, -0.003826529, 0.003943001],
                       "t_m": [-0.019871, 0.004829, 0.012417]},
  "depth_unit_m": 0.001})";

constexpr const char *kHeadset = R"({"format": "spherecloud-calibration", "version": 1, "pixel_center": 0.5,
  "color_camera": {"model": "pinhole", "width": 540, "height": 360, "params": [495.568, 495.482, 269.503, 169.194]},
  "depth_unit_m": 0.001, "depth_registered": true})";

TEST(RealRecordings, KinectIn7ScenesLayout) {
  FIND_RECORDING(folder, "redkitchen/seq-01");
  const test::TempFolder temp;
  temp.write("rig.json", kKinect);
  sphc_replay_config config = replayConfig();
  config.first = 620;
  const OpenReplay replay(folder.string(), (temp / "rig.json").c_str(), &config);
  ASSERT_EQ(replay.status(), SPHC_OK) << replay.message();
  ASSERT_EQ(sphc_replay_frame_count(replay.get()), 180u);
  EXPECT_EQ(countCaptures(replay), 360u);
  sphc_localizer_frame frame;
  sphc_message message{};
  ASSERT_EQ(sphc_replay_read_frame(replay.get(), 1, &frame, &message), SPHC_OK) << message.text;
  EXPECT_EQ(frame.sequence, 621u);
  EXPECT_EQ(frame.color_time_ns, 20700000000);
  EXPECT_GT(shareInRoom(frame.depth), 0.5);
}

TEST(RealRecordings, KinectPoseIsThatOfTheFile) {
  FIND_RECORDING(folder, "redkitchen/seq-01");
  const test::TempFolder temp;
  temp.write("rig.json", kKinect);
  sphc_replay_config config = replayConfig();
  config.first = config.last = 150;
  const OpenReplay replay(folder.string(), (temp / "rig.json").c_str(), &config);
  sphc_rigid pose;
  ASSERT_EQ(sphc_replay_pose(replay.get(), 0, &pose), SPHC_OK);
  expectRotation(pose.q_wxyz, {0.759604864, 0.361519070, -0.540651715, -0.381603058, 0.920889913, 0.079629325,
                               0.526668226, 0.145827589, 0.837469284});
  EXPECT_EQ(pose.t_m[0], -1.072779576);
}

TEST(RealRecordings, HeadsetInTumLayout) {
  FIND_RECORDING(folder, "hololens");
  const test::TempFolder temp;
  temp.write("rig.json", kHeadset);
  const OpenReplay replay(folder.string(), (temp / "rig.json").c_str());
  ASSERT_EQ(replay.status(), SPHC_OK) << replay.message();
  const uint32_t frames = sphc_replay_frame_count(replay.get());
  ASSERT_EQ(frames, 200u);
  EXPECT_EQ(countCaptures(replay), 400u);
  for (uint32_t i = 0; i < frames; ++i) {
    sphc_rigid pose;
    EXPECT_EQ(sphc_replay_pose(replay.get(), i, &pose), SPHC_OK) << i;
  }
  sphc_localizer_frame frame;
  sphc_message message{};
  ASSERT_EQ(sphc_replay_read_frame(replay.get(), 0, &frame, &message), SPHC_OK) << message.text;
  EXPECT_EQ(frame.color_time_ns, 300000000);
  EXPECT_GT(shareInRoom(frame.depth), 0.3);
  sphc_rigid pose;
  ASSERT_EQ(sphc_replay_pose(replay.get(), 0, &pose), SPHC_OK);
  EXPECT_NEAR(pose.q_wxyz[0], 0.150951589, 1e-8);
  EXPECT_NEAR(pose.q_wxyz[1], 0.793429947, 1e-8);
  EXPECT_EQ(pose.t_m[2], 4.67999);
}

TEST(RealRecordings, CalibrationOfAnotherIsRefused) {
  FIND_RECORDING(folder, "hololens");
  const test::TempFolder temp;
  temp.write("rig.json", kKinect);
  const OpenReplay replay(folder.string(), (temp / "rig.json").c_str());
  ASSERT_EQ(replay.status(), SPHC_OK);
  sphc_localizer_frame frame;
  sphc_message message{};
  EXPECT_EQ(sphc_replay_read_frame(replay.get(), 0, &frame, &message), SPHC_E_IMAGE);
  EXPECT_NE(std::string(message.text).find("is 540 x 360"), std::string::npos) << message.text;
}

}  // namespace

}  // namespace sphc::contract
