#include "host/recording/recording_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <limits>

#include "tests/support/temp_folder.h"
#include "tiny_recording.h"

namespace sphc::contract {

namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class RecordingWriter : public ::testing::Test {
 protected:
  void SetUp() override {
    const sphc_rig calibration = tinyCalibration();
    ASSERT_EQ(sphc_recording_create(folder().c_str(), &calibration, &writer_, &message_), SPHC_OK) << message_.text;
  }
  void TearDown() override { sphc_recording_abandon(&writer_); }
  sphc_status close() { return sphc_recording_close(&writer_, &message_); }

  std::string folder() const { return temp_ / "new"; }
  sphc_status addFrame(const sphc_localizer_frame &frame) {
    return sphc_recording_add_frame(writer_, &frame, &message_);
  }

  test::TempFolder temp_;
  sphc_recording_writer *writer_ = nullptr;
  sphc_message message_ = {};
  TinyImages images_{0};
};

TEST_F(RecordingWriter, WritesWhatReplayReadsBackBitForBit) {
  const test::TempFolder folder;
  writeTinyRecording(folder.path().string(), 3);
  const OpenReplay replay(folder.path().string());
  ASSERT_EQ(replay.status(), SPHC_OK) << replay.message();
  ASSERT_EQ(sphc_replay_frame_count(replay.get()), 3u);
  for (uint32_t i = 0; i < 3; ++i) {
    const TinyImages images(i);
    sphc_localizer_frame frame;
    ASSERT_EQ(sphc_replay_read_frame(replay.get(), i, &frame, nullptr), SPHC_OK);
    EXPECT_EQ(frame.struct_size, sizeof frame);
    EXPECT_EQ(frame.sequence, i);
    EXPECT_EQ(frame.color_time_ns, kFirstNs + i * kPeriodNs);
    EXPECT_EQ(frame.color.format, SPHC_FORMAT_BGR8);
    EXPECT_EQ(std::memcmp(frame.color.data, images.color.data(), images.color.size()), 0);
    EXPECT_EQ(std::memcmp(frame.depth.data, images.depth.data(), images.depth.size() * 2), 0);
    sphc_rigid pose;
    ASSERT_EQ(sphc_replay_pose(replay.get(), i, &pose), SPHC_OK);
    const sphc_rigid expected = tinyPose(i);
    EXPECT_EQ(std::memcmp(&pose, &expected, sizeof pose), 0);
  }
}

TEST_F(RecordingWriter, IsReadByNobodyUntilItIsClosed) {
  ASSERT_EQ(addFrame(tinyFrame(0, images_)), SPHC_OK);
  {
    const OpenReplay replay(folder());
    EXPECT_EQ(replay.status(), SPHC_E_DEVICE);
    EXPECT_THAT(replay.message(), AllOf(HasSubstr("not finished"), HasSubstr("unfinished.txt")));
  }
  ASSERT_EQ(close(), SPHC_OK) << message_.text;
  const OpenReplay replay(folder());
  ASSERT_EQ(replay.status(), SPHC_OK) << replay.message();
  EXPECT_EQ(sphc_replay_frame_count(replay.get()), 1u);
}

TEST_F(RecordingWriter, AKilledOneIsRefusedUntilSomebodyRemovesTheMark) {
  const std::string killed = temp_ / "killed";
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const sphc_rig calibration = tinyCalibration();
    sphc_recording_writer *writer = nullptr;
    sphc_recording_create(killed.c_str(), &calibration, &writer, nullptr);
    for (uint32_t i = 0; i < 3; ++i) {
      const TinyImages images(i);
      const sphc_localizer_frame frame = tinyFrame(i, images);
      sphc_recording_add_frame(writer, &frame, nullptr);
    }
    raise(SIGKILL);
  }
  int state = 0;
  ASSERT_EQ(waitpid(child, &state, 0), child);
  ASSERT_TRUE(WIFSIGNALED(state));
  EXPECT_EQ(OpenReplay(killed).status(), SPHC_E_DEVICE);
  std::filesystem::remove(killed + "/unfinished.txt");
  const OpenReplay replay(killed);
  ASSERT_EQ(replay.status(), SPHC_OK) << replay.message();
  EXPECT_EQ(sphc_replay_frame_count(replay.get()), 3u);
}

TEST_F(RecordingWriter, AnAbandonedOneStaysUnfinished) {
  ASSERT_EQ(addFrame(tinyFrame(0, images_)), SPHC_OK);
  sphc_recording_abandon(&writer_);
  EXPECT_EQ(writer_, nullptr);
  EXPECT_EQ(OpenReplay(folder()).status(), SPHC_E_DEVICE);
  const sphc_rig calibration = tinyCalibration();
  EXPECT_EQ(sphc_recording_create(folder().c_str(), &calibration, &writer_, &message_), SPHC_E_STATE);
  EXPECT_THAT(message_.text, HasSubstr("unfinished recording"));
}

TEST_F(RecordingWriter, TakesEveryColourFormatAndStride) {
  sphc_localizer_frame frame = tinyFrame(0, images_);
  frame.color.format = SPHC_FORMAT_RGB8;
  ASSERT_EQ(addFrame(frame), SPHC_OK);
  frame = tinyFrame(1, images_);
  frame.color.format = SPHC_FORMAT_GRAY8;  // every third byte's neighbourhood: the content does not matter
  ASSERT_EQ(addFrame(frame), SPHC_OK);
  ASSERT_EQ(close(), SPHC_OK) << message_.text;
  const OpenReplay replay(folder());
  sphc_localizer_frame read;
  ASSERT_EQ(sphc_replay_read_frame(replay.get(), 0, &read, nullptr), SPHC_OK);
  EXPECT_EQ(static_cast<const uint8_t *>(read.color.data)[0], tinyColor(0, 0, 0, 2)) << "red and blue swapped";
  ASSERT_EQ(sphc_replay_read_frame(replay.get(), 1, &read, nullptr), SPHC_OK);
  const uint8_t *second_row = static_cast<const uint8_t *>(read.color.data) + read.color.stride_bytes;
  EXPECT_EQ(second_row[0], images_.color[kColorWidth * 3]);
  EXPECT_EQ(second_row[2], images_.color[kColorWidth * 3]);
}

TEST_F(RecordingWriter, TakesTheStreamsApart) {
  sphc_capture capture{};
  capture.struct_size = sizeof capture;
  capture.stream = SPHC_STREAM_DEPTH;
  capture.time_ns = 5;
  capture.image = images_.depthImage();
  EXPECT_EQ(sphc_recording_add(writer_, &capture, &message_), SPHC_OK) << message_.text;
  capture.stream = SPHC_STREAM_COLOR;
  capture.image = images_.colorImage();
  EXPECT_EQ(sphc_recording_add(writer_, &capture, &message_), SPHC_OK) << message_.text;
  capture.stream = SPHC_STREAM_NONE;
  EXPECT_EQ(sphc_recording_add(writer_, &capture, &message_), SPHC_E_ARGUMENT);
}

TEST_F(RecordingWriter, RefusesTimesThatDoNotIncrease) {
  sphc_localizer_frame frame = tinyFrame(1, images_);
  ASSERT_EQ(addFrame(frame), SPHC_OK);
  EXPECT_EQ(addFrame(frame), SPHC_E_ARGUMENT);
  EXPECT_THAT(message_.text, HasSubstr("increasing"));
  frame.depth_time_ns = -1;
  EXPECT_EQ(addFrame(frame), SPHC_E_ARGUMENT);
  const sphc_rigid pose = tinyPose(0);
  ASSERT_EQ(sphc_recording_add_pose(writer_, 5, &pose, &message_), SPHC_OK);
  EXPECT_EQ(sphc_recording_add_pose(writer_, 5, &pose, &message_), SPHC_E_ARGUMENT);
  EXPECT_EQ(addFrame(tinyFrame(2, images_)), SPHC_OK) << "goes on";
}

TEST_F(RecordingWriter, RefusesImagesThatDoNotFit) {
  const auto refused = [&](sphc_localizer_frame frame) { return addFrame(frame) == SPHC_E_IMAGE; };
  sphc_localizer_frame frame = tinyFrame(0, images_);
  frame.color.width -= 1;
  EXPECT_TRUE(refused(frame));
  EXPECT_THAT(message_.text, AllOf(HasSubstr("47 x 32"), HasSubstr("48 x 32")));
  frame = tinyFrame(0, images_);
  frame.depth.stride_bytes = 2;
  EXPECT_TRUE(refused(frame));
  frame = tinyFrame(0, images_);
  frame.depth.format = SPHC_FORMAT_GRAY8;
  EXPECT_TRUE(refused(frame));
  frame = tinyFrame(0, images_);
  frame.color.format = 77;
  EXPECT_TRUE(refused(frame));
  frame = tinyFrame(0, images_);
  frame.color.data = nullptr;
  EXPECT_TRUE(refused(frame));
  EXPECT_EQ(addFrame(tinyFrame(0, images_)), SPHC_OK) << "goes on";
}

TEST_F(RecordingWriter, RefusesPosesThatAreNone) {
  sphc_rigid pose = tinyPose(0);
  pose.t_m[1] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(sphc_recording_add_pose(writer_, 1, &pose, &message_), SPHC_E_ARGUMENT);
  pose = tinyPose(0);
  pose.q_wxyz[0] = 2;
  EXPECT_EQ(sphc_recording_add_pose(writer_, 1, &pose, &message_), SPHC_E_ARGUMENT);
  EXPECT_THAT(message_.text, HasSubstr("unit length"));
}

TEST_F(RecordingWriter, OverwritesNothing) {
  const sphc_rig calibration = tinyCalibration();
  sphc_recording_writer *second = nullptr;
  EXPECT_EQ(sphc_recording_create(folder().c_str(), &calibration, &second, &message_), SPHC_E_STATE);
  EXPECT_EQ(second, nullptr);
  EXPECT_THAT(message_.text, HasSubstr("already"));
}

TEST_F(RecordingWriter, StopsAfterAWriteThatFailed) {
  std::filesystem::remove_all(folder() + "/rgb");
  EXPECT_EQ(addFrame(tinyFrame(0, images_)), SPHC_E_DEVICE);
  EXPECT_THAT(message_.text, HasSubstr("rgb/000000.png"));
  EXPECT_EQ(addFrame(tinyFrame(1, images_)), SPHC_E_STATE);
  EXPECT_EQ(close(), SPHC_E_STATE) << "half a recording is not finished";
  EXPECT_EQ(writer_, nullptr);
  EXPECT_EQ(OpenReplay(folder()).status(), SPHC_E_DEVICE);
}

TEST_F(RecordingWriter, ChecksItsArguments) {
  const sphc_rig calibration{};
  sphc_recording_writer *none = nullptr;
  EXPECT_EQ(sphc_recording_create(nullptr, &calibration, &none, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_recording_create("x", &calibration, &none, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_recording_add(nullptr, nullptr, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_recording_add_frame(writer_, nullptr, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_recording_add_pose(writer_, 0, nullptr, nullptr), SPHC_E_ARGUMENT);
  sphc_localizer_frame frame = tinyFrame(0, images_);
  frame.struct_size = 4;
  EXPECT_EQ(addFrame(frame), SPHC_E_STRUCT_SIZE);
  EXPECT_EQ(sphc_recording_close(nullptr, nullptr), SPHC_OK);
  EXPECT_EQ(sphc_recording_close(&none, nullptr), SPHC_OK);
  sphc_recording_abandon(nullptr);
  sphc_recording_abandon(&none);
}

}  // namespace

}  // namespace sphc::contract
