#include "drivers/replay/replay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstring>
#include <optional>
#include <string>

#include "tests/support/temp_folder.h"
#include "tiny_recording.h"

namespace sphc::contract {

namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using Clock = std::chrono::steady_clock;

class Replay : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    temp_ = new test::TempFolder;
    writeTinyRecording(temp_->path().string(), 4);
  }
  static void TearDownTestSuite() {
    delete temp_;
    temp_ = nullptr;
  }
  static std::string folder() { return temp_->path().string(); }

  static test::TempFolder *temp_;
  sphc_replay_config config_ = replayConfig();
};
test::TempFolder *Replay::temp_ = nullptr;

TEST_F(Replay, RefusesABadConfig) {
  const auto refusal = [&](auto change) {
    sphc_replay_config config = replayConfig();
    change(config);
    const OpenReplay replay(folder(), nullptr, &config);
    EXPECT_EQ(replay.status(), SPHC_E_ARGUMENT);
    return replay.message();
  };
  EXPECT_THAT(refusal([](auto &c) { c.mode = 0; }), HasSubstr("config.mode"));
  EXPECT_THAT(refusal([](auto &c) { c.streams = 0; }), HasSubstr("config.streams"));
  EXPECT_THAT(refusal([](auto &c) { c.streams = 4; }), HasSubstr("config.streams"));
  EXPECT_THAT(refusal([](auto &c) { c.color_format = SPHC_FORMAT_DEPTH16; }), HasSubstr("config.color_format"));
  EXPECT_THAT(refusal([](auto &c) { c.first = 2, c.last = 1; }), HasSubstr("config.first"));
  EXPECT_THAT(refusal([](auto &c) { c.step = 0; }), HasSubstr("config.step"));
  EXPECT_THAT(refusal([](auto &c) { c.loan_limit = 0; }), HasSubstr("config.loan_limit"));
  EXPECT_THAT(refusal([](auto &c) { c.loan_limit = 65; }), HasSubstr("config.loan_limit"));
  EXPECT_THAT(refusal([](auto &c) { c.pair_tolerance_ns = -1; }), HasSubstr("config.pair_tolerance_ns"));
  EXPECT_THAT(refusal([](auto &c) { c.pose_gap_ns = -1; }), HasSubstr("config.pose_gap_ns"));
  sphc_replay_config config{};
  EXPECT_EQ(OpenReplay(folder(), nullptr, &config).status(), SPHC_E_STRUCT_SIZE);
}

TEST_F(Replay, RefusesAFolderWithoutARecording) {
  const test::TempFolder empty;
  const OpenReplay replay(empty.path().string());
  EXPECT_EQ(replay.status(), SPHC_E_DEVICE);
  EXPECT_THAT(replay.message(), AllOf(HasSubstr("rgb.txt"), HasSubstr("frame-000000.color.png")));
  const OpenReplay none(empty / "none");
  EXPECT_EQ(none.status(), SPHC_E_DEVICE);
  EXPECT_THAT(none.message(), HasSubstr("no such folder"));
  EXPECT_THAT(OpenReplay(std::string(300, 'x')).message(),
              HasSubstr("cannot be read: File name too long; check its name"));
}

TEST_F(Replay, AsksForACalibration) {
  const OpenReplay replay(folder(), (folder() + "/rig.json").c_str());
  EXPECT_EQ(replay.status(), SPHC_E_DEVICE);
  EXPECT_EQ(replay.get(), nullptr);
  EXPECT_THAT(replay.message(), AllOf(HasSubstr("rig.json"), HasSubstr("docs/drivers.md")));
}

TEST_F(Replay, GivesItsCalibration) {
  const OpenReplay replay(folder());
  sphc_rig rig;
  ASSERT_EQ(sphc_replay_rig(replay.get(), &rig), SPHC_OK);
  const sphc_rig expected = tinyCalibration();
  EXPECT_EQ(std::memcmp(&rig, &expected, sizeof rig), 0);
  EXPECT_EQ(sphc_replay_rig(replay.get(), nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_replay_rig(nullptr, &rig), SPHC_E_ARGUMENT);
}

TEST_F(Replay, DecodesTheFormatAskedFor) {
  config_.color_format = SPHC_FORMAT_RGB8;
  const OpenReplay rgb(folder(), nullptr, &config_);
  sphc_localizer_frame frame;
  ASSERT_EQ(sphc_replay_read_frame(rgb.get(), 1, &frame, nullptr), SPHC_OK);
  EXPECT_EQ(frame.color.format, SPHC_FORMAT_RGB8);
  EXPECT_EQ(static_cast<const uint8_t *>(frame.color.data)[0], tinyColor(1, 0, 0, 2));
  EXPECT_EQ(static_cast<const uint8_t *>(frame.color.data)[2], tinyColor(1, 0, 0, 0));
  config_.color_format = SPHC_FORMAT_GRAY8;
  const OpenReplay gray(folder(), nullptr, &config_);
  ASSERT_EQ(sphc_replay_read_frame(gray.get(), 1, &frame, nullptr), SPHC_OK);
  EXPECT_EQ(frame.color.format, SPHC_FORMAT_GRAY8);
  EXPECT_EQ(frame.color.stride_bytes, kColorWidth);
}

TEST_F(Replay, UsesTheSameBuffersForEveryFrame) {
  const OpenReplay replay(folder());
  sphc_localizer_frame first;
  sphc_localizer_frame second;
  ASSERT_EQ(sphc_replay_read_frame(replay.get(), 0, &first, nullptr), SPHC_OK);
  ASSERT_EQ(sphc_replay_read_frame(replay.get(), 1, &second, nullptr), SPHC_OK);
  EXPECT_EQ(first.color.data, second.color.data);
  EXPECT_EQ(first.depth.data, second.depth.data);
}

TEST_F(Replay, GivesTheChosenStreamOnly) {
  config_.streams = SPHC_REPLAY_STREAM_DEPTH;
  const OpenReplay replay(folder(), nullptr, &config_);
  sphc_source source;
  ASSERT_EQ(sphc_replay_source(replay.get(), &source), SPHC_OK);
  ASSERT_EQ(source.start(source.self), SPHC_OK);
  for (uint32_t i = 0; i < 4; ++i) {
    sphc_capture capture = {};
    capture.struct_size = sizeof capture;
    ASSERT_EQ(source.acquire(source.self, 0, &capture), SPHC_OK);
    EXPECT_EQ(capture.stream, SPHC_STREAM_DEPTH);
    EXPECT_EQ(capture.time_ns, kFirstNs + i * kPeriodNs + kDepthLagNs);
  }
  sphc_capture capture = {};
  capture.struct_size = sizeof capture;
  EXPECT_EQ(source.acquire(source.self, 0, &capture), SPHC_END);
}

TEST_F(Replay, KeepsTheRecordedPaceInRealTime) {
  config_.mode = SPHC_REPLAY_REAL_TIME;
  config_.streams = SPHC_REPLAY_STREAM_COLOR;
  const OpenReplay replay(folder(), nullptr, &config_);
  sphc_source source;
  ASSERT_EQ(sphc_replay_source(replay.get(), &source), SPHC_OK);
  const Clock::time_point begin = Clock::now();
  ASSERT_EQ(source.start(source.self), SPHC_OK);
  for (uint32_t i = 0; i < 4; ++i) {
    sphc_capture capture = {};
    capture.struct_size = sizeof capture;
    sphc_status status = SPHC_AGAIN;
    while ((status = source.acquire(source.self, 1000, &capture)) == SPHC_AGAIN) continue;
    ASSERT_EQ(status, SPHC_OK);
    EXPECT_GE(Clock::now() - begin, std::chrono::nanoseconds(i * kPeriodNs)) << "too early";
  }
}

// A recording of two colour images, played in real time, whose first frame was taken.
class LateImage {
 public:
  LateImage(const std::string &first_s, const std::string &second_s) {
    writeTinyRecording(folder_.path().string(), 2);
    folder_.write("rgb.txt", first_s + " rgb/000000.png\n" + second_s + " rgb/000001.png\n");
    folder_.write("depth.txt", first_s + " depth/000000.png\n");
    sphc_replay_config config = replayConfig();
    config.mode = SPHC_REPLAY_REAL_TIME;
    replay_.emplace(folder_.path().string(), nullptr, &config);
    EXPECT_EQ(sphc_replay_source(replay_->get(), &source_), SPHC_OK);
    EXPECT_EQ(source_.start(source_.self), SPHC_OK);
    for (int image = 0; image < 2; ++image) EXPECT_EQ(acquire(0), SPHC_OK);
  }
  sphc_status acquire(uint32_t timeout_us) {
    sphc_capture capture = {};
    capture.struct_size = sizeof capture;
    return source_.acquire(source_.self, timeout_us, &capture);
  }

 private:
  const test::TempFolder folder_;
  std::optional<OpenReplay> replay_;
  sphc_source source_ = {};
};

TEST_F(Replay, SaysAgainUntilTheTimeHasCome) {
  LateImage late("10.0", "1000.0");
  const Clock::time_point begin = Clock::now();
  EXPECT_EQ(late.acquire(0), SPHC_AGAIN);
  EXPECT_EQ(late.acquire(30000), SPHC_AGAIN);
  EXPECT_GE(Clock::now() - begin, std::chrono::milliseconds(30));
}

// The latest that a list can tell: more than the host's clock can count on from now.
TEST_F(Replay, ATimeInCenturiesHasNotCome) {
  LateImage late("0.0", "9223372035.9");
  EXPECT_EQ(late.acquire(1000), SPHC_AGAIN);
}

TEST_F(Replay, ChecksItsArguments) {
  const OpenReplay replay(folder());
  sphc_localizer_frame frame;
  sphc_message message{};
  EXPECT_EQ(sphc_replay_read_frame(replay.get(), 4, &frame, &message), SPHC_E_ARGUMENT);
  EXPECT_THAT(message.text, HasSubstr("frame 4: there are 4"));
  EXPECT_EQ(sphc_replay_read_frame(nullptr, 0, &frame, nullptr), SPHC_E_ARGUMENT);
  sphc_rigid pose;
  EXPECT_EQ(sphc_replay_pose(replay.get(), 4, &pose), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_replay_pose(replay.get(), 0, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_replay_pose_at(nullptr, 0, &pose), SPHC_E_ARGUMENT);
  sphc_replay_info info{};
  EXPECT_EQ(sphc_replay_get_info(replay.get(), &info), SPHC_E_STRUCT_SIZE);
  sphc_replay_frame_info frame_info{};
  EXPECT_EQ(sphc_replay_get_frame_info(replay.get(), 0, &frame_info), SPHC_E_STRUCT_SIZE);
  EXPECT_EQ(sphc_replay_get_frame_info(replay.get(), 9, &frame_info), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_replay_source(replay.get(), nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_replay_open(nullptr, nullptr, nullptr, nullptr, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_replay_frame_count(nullptr), 0u);
  EXPECT_EQ(sphc_replay_config_init(nullptr, 0), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_replay_config_init(&config_, 3), SPHC_E_STRUCT_SIZE);
  sphc_replay *none = nullptr;
  sphc_replay_close(nullptr);
  sphc_replay_close(&none);
}

}  // namespace

}  // namespace sphc::contract
