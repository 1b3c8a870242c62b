#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

#include "host/recording/calibration.h"
#include "host/recording/failure.h"
#include "host/recording/recorder.h"
#include "host/recording/recording_writer.h"
#include "host/recording/writer_raw.h"
#include "tests/support/spoiled_rigs.h"
#include "tests/support/temp_folder.h"
#include "tiny_recording.h"

namespace sphc::contract {

namespace {

using test::SpoiledRig;
using ::testing::HasSubstr;

// What writes a rig refuses the same rigs, by the same words, and writes nothing.
void refusesSpoiledRigs(
    const std::function<sphc_status(const std::string &path, const sphc_rig &rig, sphc_message *message)> &write) {
  for (const SpoiledRig &spoiled : test::spoiledRigs()) {
    const test::TempFolder folder;
    sphc_rig rig = tinyCalibration();
    spoiled.spoil(&rig);
    sphc_message message = {};
    EXPECT_EQ(write(folder / "out", rig, &message), SPHC_E_ARGUMENT);
    EXPECT_STREQ(message.text, spoiled.message);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  }
}

TEST(RefusedRigs, CalibrationFile) {
  refusesSpoiledRigs([](const std::string &path, const sphc_rig &rig, sphc_message *message) {
    return sphc_calibration_write(path.c_str(), &rig, message);
  });
}

TEST(RefusedRigs, Recorder) {
  refusesSpoiledRigs([](const std::string &path, const sphc_rig &rig, sphc_message *message) {
    sphc_recorder *recorder = nullptr;
    return sphc_recorder_open(path.c_str(), &rig, nullptr, &recorder, message);
  });
}

TEST(RefusedRigs, RecordingInAFolder) {
  refusesSpoiledRigs([](const std::string &path, const sphc_rig &rig, sphc_message *message) {
    sphc_recording_writer *writer = nullptr;
    return sphc_recording_create(path.c_str(), &rig, &writer, message);
  });
}

TEST(RefusedRigs, RawRecording) {
  refusesSpoiledRigs([](const std::string &path, const sphc_rig &rig, sphc_message *message) {
    return recording::guarded(message, [&]() -> sphc_status {
      recording::RawWriter(path, rig, SPHC_FORMAT_BGR8);
      return SPHC_OK;
    });
  });
}

// What can stand in a file at all is refused with the file's name before the same words.
TEST(RefusedRigs, FileThatIsRead) {
  const std::string good = R"({
    "format": "spherecloud-calibration", "version": 1, "pixel_center": 0.5,
    "color_camera": {"model": "pinhole", "width": 640, "height": 480, "params": [500, 500, 320, 240]},
    "depth_camera": {"model": "pinhole", "width": 320, "height": 240, "params": [290, 290, 160, 120]},
    "color_from_depth": {"q_wxyz": [1, 0, 0, 0], "t_m": [0, 0, 0]}, "depth_unit_m": 0.001})";
  const struct {
    const char *from, *to, *message;
  } cases[] = {
      {"[500, 500,", "[0, 500,",
       "c.json: color_camera.params[0] is 0; a focal length must be positive and at most 1000000: check the "
       "calibration"},
      {"[0, 0, 0]", "[0, -10.5, 0]",
       "c.json: color_from_depth.t_m[1] is -10.5; it must lie in -10 to 10: give metres"},
      {"[1, 0, 0, 0]", "[1.01, 0, 0, 0]",
       "c.json: color_from_depth.q_wxyz has length 1.01; it must be 1 (order w x y z): divide by its length"},
      {"0.001}", "0.11}", "c.json: depth_unit_m is 0.11; it must lie in 1e-6 to 0.1 (0.001 for millimetres)"},
  };
  for (const auto &c : cases) {
    std::string text = good;
    const size_t at = text.find(c.from);
    ASSERT_NE(at, std::string::npos) << c.from;
    text.replace(at, std::string(c.from).size(), c.to);
    sphc_rig rig;
    sphc_message message = {};
    EXPECT_EQ(sphc_calibration_parse(text.data(), text.size(), "c.json", &rig, &message), SPHC_E_ARGUMENT);
    EXPECT_STREQ(message.text, c.message);
  }
}

}  // namespace

}  // namespace sphc::contract
