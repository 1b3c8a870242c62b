#include "host/recording/recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <limits>

#include "file_size_limit.h"
#include "host/recording/recording_encoder.h"
#include "tests/support/temp_folder.h"
#include "tiny_mcap.h"

namespace sphc::contract {

namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

sphc_recorder_statistics statisticsOf(const sphc_recorder *recorder) {
  sphc_recorder_statistics statistics{};
  statistics.struct_size = sizeof statistics;
  EXPECT_EQ(sphc_recorder_get_statistics(recorder, &statistics), SPHC_OK);
  return statistics;
}

void expectTinyFrame(const OpenReplay &replay, uint32_t i) {
  sphc_localizer_frame frame;
  sphc_message message{};
  ASSERT_EQ(sphc_replay_read_frame(replay.get(), i, &frame, &message), SPHC_OK) << message.text;
  const TinyImages images(i);
  EXPECT_EQ(frame.sequence, i);
  EXPECT_EQ(frame.color_time_ns, kFirstNs + i * kPeriodNs);
  EXPECT_EQ(frame.depth_time_ns, kFirstNs + i * kPeriodNs + kDepthLagNs);
  EXPECT_EQ(std::memcmp(frame.color.data, images.color.data(), images.color.size()), 0) << "colour " << i;
  EXPECT_EQ(std::memcmp(frame.depth.data, images.depth.data(), images.depth.size() * 2), 0) << "depth " << i;
}

// Colour and depth of one frame only, else the last colour image of a cut file would find the depth before it.
sphc_replay_config tightConfig() {
  sphc_replay_config config = replayConfig();
  config.pair_tolerance_ns = 2 * kDepthLagNs;
  return config;
}

class Recorder : public ::testing::Test {
 protected:
  std::string file() const { return temp_ / "walk.mcap"; }

  test::TempFolder temp_;
  sphc_recorder_config config_ = recorderConfig();
};

class RecorderCodecs : public Recorder, public ::testing::WithParamInterface<sphc_depth_codec> {};

TEST_P(RecorderCodecs, WhatIsRecordedIsReplayedBitForBit) {
  config_.depth_codec = GetParam();
  writeTinyMcap(file(), 40, config_);
  const OpenReplay replay(file());
  ASSERT_EQ(replay.status(), SPHC_OK) << replay.message();
  const sphc_replay_info info = infoOf(replay);
  EXPECT_EQ(info.layout, SPHC_REPLAY_MCAP);
  EXPECT_EQ(info.color_count, 40u);
  EXPECT_EQ(info.depth_count, 40u);
  EXPECT_EQ(info.pose_count, 40u);
  EXPECT_EQ(info.lost_count, 0u);
  EXPECT_EQ(info.is_cut, 0u);
  ASSERT_EQ(sphc_replay_frame_count(replay.get()), 40u);
  for (const uint32_t i : {0u, 39u, 7u, 8u}) {
    expectTinyFrame(replay, i);
    sphc_rigid pose;
    ASSERT_EQ(sphc_replay_pose(replay.get(), i, &pose), SPHC_OK);
    const sphc_rigid expected = tinyPose(i);
    EXPECT_EQ(std::memcmp(&pose, &expected, sizeof pose), 0);
  }
  sphc_rig calibration;
  sphc_rig_init(&calibration);
  ASSERT_EQ(sphc_replay_rig(replay.get(), &calibration), SPHC_OK);
  const sphc_rig expected = tinyCalibration();
  EXPECT_EQ(std::memcmp(&calibration, &expected, sizeof calibration), 0);
}
INSTANTIATE_TEST_SUITE_P(Each, RecorderCodecs, ::testing::Values(SPHC_DEPTH_RAW, SPHC_DEPTH_RVL, SPHC_DEPTH_ZSTD));

TEST_F(Recorder, KeepsWhatACaptureSays) {
  writeTinyMcap(file(), 3, config_);
  const OpenReplay replay(file());
  sphc_source source;
  ASSERT_EQ(sphc_replay_source(replay.get(), &source), SPHC_OK);
  ASSERT_EQ(source.start(source.self), SPHC_OK);
  for (uint32_t i = 0; i < 6; ++i) {
    const TinyImages images(i / 2);
    const sphc_capture expected = tinyCapture(i / 2, i % 2 ? SPHC_STREAM_DEPTH : SPHC_STREAM_COLOR, images);
    sphc_capture capture{};
    capture.struct_size = sizeof capture;
    ASSERT_EQ(source.acquire(source.self, 0, &capture), SPHC_OK) << source.message(source.self);
    EXPECT_EQ(capture.stream, expected.stream);
    EXPECT_EQ(capture.time_ns, expected.time_ns);
    EXPECT_EQ(capture.sequence, expected.sequence);
    EXPECT_EQ(capture.arrival_ns, expected.arrival_ns);
    EXPECT_EQ(capture.exposure_us, expected.exposure_us);
    EXPECT_EQ(capture.time_sigma_us, expected.time_sigma_us);
    EXPECT_EQ(capture.clock, expected.clock);
    EXPECT_EQ(capture.time_point, expected.time_point);
    source.release(source.self, &capture);
  }
}

TEST_F(Recorder, KeepsEveryColourFormatAndStride) {
  for (const sphc_format format : {SPHC_FORMAT_BGR8, SPHC_FORMAT_RGB8, SPHC_FORMAT_GRAY8}) {
    const std::string path = temp_ / std::to_string(format);
    const TinyImages images(5);
    OpenRecorder recorder(path, config_);
    sphc_capture capture = tinyCapture(0, SPHC_STREAM_COLOR, images);
    capture.image.format = format;  // grey rows keep the wide stride
    ASSERT_EQ(sphc_recorder_add(recorder.get(), &capture, nullptr), SPHC_OK);
    const sphc_capture depth = tinyCapture(0, SPHC_STREAM_DEPTH, images);
    ASSERT_EQ(sphc_recorder_add(recorder.get(), &depth, nullptr), SPHC_OK);
    ASSERT_EQ(recorder.close(), SPHC_OK) << recorder.message();
    sphc_replay_config config = replayConfig();
    config.color_format = format;
    const OpenReplay replay(path, nullptr, &config);
    sphc_localizer_frame frame;
    ASSERT_EQ(sphc_replay_read_frame(replay.get(), 0, &frame, nullptr), SPHC_OK) << replay.message();
    const uint32_t row_bytes = frame.color.stride_bytes;
    ASSERT_EQ(row_bytes, kColorWidth * (format == SPHC_FORMAT_GRAY8 ? 1 : 3));
    for (uint32_t y = 0; y < kColorHeight; ++y)
      EXPECT_EQ(std::memcmp(static_cast<const uint8_t *>(frame.color.data) + y * row_bytes,
                            images.color.data() + y * kColorWidth * 3, row_bytes),
                0);
  }
}

// The same colour, whichever way it came: through a PNG of the folder layout or through the file.
TEST_F(Recorder, GivesTheColoursOfTheFolderLayout) {
  writeTinyRecording(temp_ / "folder", 2);
  writeTinyMcap(file(), 2, config_);
  for (const sphc_format format : {SPHC_FORMAT_BGR8, SPHC_FORMAT_RGB8, SPHC_FORMAT_GRAY8}) {
    sphc_replay_config config = replayConfig();
    config.color_format = format;
    const OpenReplay folder(temp_ / "folder", nullptr, &config), mcap(file(), nullptr, &config);
    sphc_localizer_frame a, b;
    ASSERT_EQ(sphc_replay_read_frame(folder.get(), 1, &a, nullptr), SPHC_OK);
    ASSERT_EQ(sphc_replay_read_frame(mcap.get(), 1, &b, nullptr), SPHC_OK);
    EXPECT_EQ(std::memcmp(a.color.data, b.color.data, size_t{a.color.stride_bytes} * kColorHeight), 0) << format;
  }
}

TEST_F(Recorder, KeepsColourAsJpegWhenAsked) {
  config_.jpeg_quality = 100;
  writeTinyMcap(file(), 2, config_);
  const OpenReplay replay(file());
  sphc_localizer_frame frame;
  ASSERT_EQ(sphc_replay_read_frame(replay.get(), 1, &frame, nullptr), SPHC_OK);
  const TinyImages images(1);
  const auto *color = static_cast<const uint8_t *>(frame.color.data);
  double error = 0;
  for (size_t i = 0; i < images.color.size(); ++i) error += std::abs(color[i] - images.color[i]);
  EXPECT_GT(error, 0) << "JPEG is not lossless: is it one?";
  EXPECT_LT(error / static_cast<double>(images.color.size()), 16.0);  // the pattern wraps from 255 to 0
  EXPECT_EQ(std::memcmp(frame.depth.data, images.depth.data(), images.depth.size() * 2), 0);
}

TEST_F(Recorder, CountsAndListsGapsInASequence) {
  OpenRecorder recorder(file(), config_);
  for (const uint32_t i : {0u, 1u, 4u, 5u, 7u}) {
    const TinyImages images(i);
    const sphc_capture capture = tinyCapture(i, SPHC_STREAM_COLOR, images);
    ASSERT_EQ(sphc_recorder_add(recorder.get(), &capture, nullptr), SPHC_OK);
  }
  EXPECT_EQ(statisticsOf(recorder.get()).missing_count, 3u);
  EXPECT_EQ(statisticsOf(recorder.get()).dropped_count, 0u);
  ASSERT_EQ(recorder.close(), SPHC_OK);
  const OpenReplay replay(file());
  EXPECT_EQ(infoOf(replay).lost_count, 3u);
  EXPECT_EQ(infoOf(replay).color_count, 5u);
}

TEST_F(Recorder, CountsNoGapsOfNumbersThatAreNoCounter) {
  config_.gaps_are_losses = 0;
  OpenRecorder recorder(file(), config_);
  for (const uint32_t i : {0u, 3u, 6u}) {
    const TinyImages images(i);
    const sphc_capture capture = tinyCapture(i, SPHC_STREAM_COLOR, images);
    ASSERT_EQ(sphc_recorder_add(recorder.get(), &capture, nullptr), SPHC_OK);
  }
  EXPECT_EQ(statisticsOf(recorder.get()).missing_count, 0u);
  ASSERT_EQ(recorder.close(), SPHC_OK);
  EXPECT_EQ(infoOf(OpenReplay(file())).lost_count, 0u);
}

TEST_F(Recorder, CountsAndListsWhatAFullQueueDrops) {
  config_.queue_slots = 2;
  config_.wait_us = 0;
  config_.jpeg_quality = 100;  // takes longer than a copy
  OpenRecorder recorder(file(), config_);
  uint32_t kept = 0, dropped = 0;
  const TinyImages images(0);
  for (uint32_t i = 0; i < 100000 && (dropped < 3 || i < 100); ++i) {
    const sphc_capture capture = tinyCapture(i, SPHC_STREAM_COLOR, images);
    const sphc_status status = sphc_recorder_add(recorder.get(), &capture, nullptr);
    ASSERT_TRUE(status == SPHC_OK || status == SPHC_AGAIN) << status;
    ++(status == SPHC_OK ? kept : dropped);
  }
  EXPECT_GE(dropped, 3u);
  EXPECT_EQ(statisticsOf(recorder.get()).dropped_count, dropped);
  EXPECT_EQ(statisticsOf(recorder.get()).queue_most, 2u);
  ASSERT_EQ(recorder.close(), SPHC_OK);
  const OpenReplay replay(file());
  EXPECT_EQ(infoOf(replay).color_count, kept);
  EXPECT_EQ(infoOf(replay).lost_count, dropped);
}

TEST_F(Recorder, WaitsForAFreeSlotWhenAsked) {
  config_.queue_slots = 2;
  config_.wait_us = 60000000;
  OpenRecorder recorder(file(), config_);
  const TinyImages images(0);
  for (uint32_t i = 0; i < 300; ++i) {
    const sphc_capture capture = tinyCapture(i, SPHC_STREAM_COLOR, images);
    ASSERT_EQ(sphc_recorder_add(recorder.get(), &capture, nullptr), SPHC_OK);
  }
  ASSERT_EQ(recorder.close(), SPHC_OK);
  EXPECT_EQ(infoOf(OpenReplay(file())).color_count, 300u);
}

TEST_F(Recorder, OverwritesNothing) {
  temp_.write("walk.mcap", "mine");
  OpenRecorder recorder(file(), config_);
  EXPECT_EQ(recorder.status(), SPHC_E_STATE);
  EXPECT_THAT(recorder.message(), HasSubstr("walk.mcap"));
  EXPECT_EQ(temp_.read("walk.mcap"), "mine");
  EXPECT_EQ(OpenRecorder(temp_ / "no/walk.mcap", config_).status(), SPHC_E_DEVICE);
}

TEST_F(Recorder, RefusesWhatDoesNotFitAndGoesOn) {
  OpenRecorder recorder(file(), config_);
  const TinyImages images(0);
  sphc_message message{};
  const auto add = [&](const sphc_capture &capture) {
    return sphc_recorder_add(recorder.get(), &capture, &message);
  };
  const sphc_capture good = tinyCapture(0, SPHC_STREAM_COLOR, images);
  sphc_capture bad = good;
  bad.image.width -= 1;
  EXPECT_EQ(add(bad), SPHC_E_IMAGE);
  EXPECT_THAT(message.text, AllOf(HasSubstr("47 x 32"), HasSubstr("48 x 32")));
  bad = good;
  bad.image.data = nullptr;
  EXPECT_EQ(add(bad), SPHC_E_IMAGE);
  bad = good;
  bad.stream = SPHC_STREAM_DEPTH;
  EXPECT_EQ(add(bad), SPHC_E_IMAGE);
  bad = good;
  bad.stream = 7;
  EXPECT_EQ(add(bad), SPHC_E_ARGUMENT);
  bad = good;
  bad.time_ns = -1;
  EXPECT_EQ(add(bad), SPHC_E_ARGUMENT);
  bad = good;
  bad.struct_size = 3;
  EXPECT_EQ(add(bad), SPHC_E_STRUCT_SIZE);
  EXPECT_EQ(add(good), SPHC_OK);
  EXPECT_EQ(add(good), SPHC_E_ARGUMENT);
  EXPECT_THAT(message.text, HasSubstr("increasing"));
  sphc_rigid pose = tinyPose(0);
  pose.q_wxyz[0] = 2;
  EXPECT_EQ(sphc_recorder_add_pose(recorder.get(), 1, &pose, &message), SPHC_E_ARGUMENT);
  ASSERT_EQ(recorder.close(), SPHC_OK);
  EXPECT_EQ(infoOf(OpenReplay(file())).color_count, 1u);
}

// Number i, at 2 ms times i.
void addAccelerations(sphc_recorder *recorder, uint32_t first, uint32_t end) {
  for (uint32_t i = first; i < end; ++i) {
    const double felt[3] = {0.5 * i, -1.25, 9.75};
    ASSERT_EQ(sphc_recorder_add_acceleration(recorder, 2000000 * int64_t{i}, felt, nullptr), SPHC_OK) << i;
  }
}

void expectAccelerations(const OpenReplay &replay, uint32_t count) {
  ASSERT_EQ(infoOf(replay).acceleration_count, count);
  for (uint32_t i = 0; i < count; ++i) {
    int64_t time_ns = 0;
    double felt[3];
    ASSERT_EQ(sphc_replay_acceleration(replay.get(), i, &time_ns, felt), SPHC_OK);
    ASSERT_EQ(time_ns, 2000000 * int64_t{i});
    ASSERT_THAT(felt, ::testing::ElementsAre(0.5 * i, -1.25, 9.75));
  }
  int64_t time_ns = 0;
  double felt[3];
  EXPECT_EQ(sphc_replay_acceleration(replay.get(), count, &time_ns, felt), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_replay_acceleration(nullptr, 0, &time_ns, felt), SPHC_E_ARGUMENT);
}

TEST_F(Recorder, KeepsAccelerationsBetweenImagesAndWithoutAny) {
  config_.wait_us = 10000000;
  OpenRecorder recorder(file(), config_);
  addAccelerations(recorder.get(), 0, 40);
  addTinyFrames(recorder.get(), 2);
  addAccelerations(recorder.get(), 40, 1000);  // more than wait for a capture
  addAccelerations(recorder.get(), 1000, 1003);
  ASSERT_EQ(recorder.close(), SPHC_OK) << recorder.message();
  const OpenReplay replay(file());
  expectAccelerations(replay, 1003);
  EXPECT_EQ(infoOf(replay).color_count, 2u);
  EXPECT_EQ(infoOf(replay).lost_count, 0u);
  EXPECT_EQ(infoOf(replay).pose_count, 2u);
}

TEST_F(Recorder, CountsAccelerationsThatFoundNoSlot) {
  config_.queue_slots = 2;
  config_.wait_us = 0;
  OpenRecorder recorder(file(), config_);
  uint32_t kept = 0, dropped = 0;
  const double felt[3] = {0, 0, 9.8};
  for (uint32_t i = 0; i < 2000000 && dropped == 0; ++i) {
    const sphc_status status = sphc_recorder_add_acceleration(recorder.get(), i, felt, nullptr);
    ASSERT_TRUE(status == SPHC_OK || status == SPHC_AGAIN) << status;
    ++(status == SPHC_OK ? kept : dropped);
  }
  ASSERT_EQ(dropped, 1u) << "a copy is faster than the writer";
  EXPECT_EQ(statisticsOf(recorder.get()).dropped_count, 1u);
  const TinyImages images(0);
  sphc_capture capture = tinyCapture(0, SPHC_STREAM_COLOR, images);
  while (sphc_recorder_add(recorder.get(), &capture, nullptr) == SPHC_AGAIN) capture.time_ns += 1000;
  ASSERT_EQ(recorder.close(), SPHC_OK);
  const OpenReplay replay(file());
  ASSERT_EQ(replay.status(), SPHC_OK) << replay.message();
  EXPECT_EQ(infoOf(replay).acceleration_count, kept);
  EXPECT_GE(infoOf(replay).lost_count, 1u);
}

TEST_F(Recorder, RefusesAccelerationsThatAreNone) {
  OpenRecorder recorder(file(), config_);
  sphc_message message{};
  const auto add = [&](int64_t time_ns, double x) {
    const double felt[3] = {x, 0, 9.8};
    return sphc_recorder_add_acceleration(recorder.get(), time_ns, felt, &message);
  };
  EXPECT_EQ(add(0, std::numeric_limits<double>::quiet_NaN()), SPHC_E_ARGUMENT);
  EXPECT_THAT(message.text, HasSubstr("m/s^2"));
  EXPECT_EQ(add(0, std::numeric_limits<double>::infinity()), SPHC_E_ARGUMENT);
  EXPECT_EQ(add(0, 1e300), SPHC_E_ARGUMENT);
  const double zero[3] = {};
  EXPECT_EQ(sphc_recorder_add_acceleration(recorder.get(), 0, zero, &message), SPHC_E_ARGUMENT);
  EXPECT_EQ(add(-1, 0), SPHC_E_ARGUMENT);
  EXPECT_EQ(add(7, 0), SPHC_OK);
  EXPECT_EQ(add(7, 0), SPHC_E_ARGUMENT);
  EXPECT_THAT(message.text, HasSubstr("increasing"));
  EXPECT_EQ(sphc_recorder_add_acceleration(recorder.get(), 8, nullptr, &message), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_recorder_add_acceleration(nullptr, 8, nullptr, &message), SPHC_E_ARGUMENT);
  addTinyFrames(recorder.get(), 1);
  ASSERT_EQ(recorder.close(), SPHC_OK);
  EXPECT_EQ(infoOf(OpenReplay(file())).acceleration_count, 1u);
}

// In a file that our recorder would not write.
TEST_F(Recorder, AccelerationsThatAreNoneAreLeftOutAndCounted) {
  const TinyImages images(0);
  const sphc_capture color = tinyCapture(0, SPHC_STREAM_COLOR, images);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  recording::CaptureNote note{};
  note.time_ns = color.time_ns;
  recording::RecordingEncoder encoder(file(), tinyCalibration(), config_);
  const recording::TimedAcceleration felt[] = {{7, {0, 0, 9}},   {7, {0, 0, 8}}, {5, {0, 0, 9}},
                                               {8, {nan, 0, 9}}, {9, {0, 0, 0}}, {10, {0, 0, 7}}};
  for (const recording::TimedAcceleration &each : felt) encoder.addAcceleration(each);
  encoder.add(note, color.image, {});
  encoder.finish({});
  const OpenReplay replay(file());
  ASSERT_EQ(replay.status(), SPHC_OK) << replay.message();
  ASSERT_EQ(infoOf(replay).acceleration_count, 2u);
  EXPECT_EQ(infoOf(replay).bad_acceleration_count, 4u);
  int64_t time_ns = 0;
  double last[3];
  ASSERT_EQ(sphc_replay_acceleration(replay.get(), 1, &time_ns, last), SPHC_OK);
  EXPECT_EQ(time_ns, 10);
  EXPECT_EQ(last[2], 7);
}

// As those of poses: nobody reads them again.
TEST_F(Recorder, LeavesOutAccelerationsOfAChangedChunk) {
  {
    OpenRecorder recorder(file(), config_);
    addAccelerations(recorder.get(), 0, 20);
    addTinyFrames(recorder.get(), 1);
    ASSERT_EQ(recorder.close(), SPHC_OK);
  }
  std::string bytes = temp_.read("walk.mcap");
  const ChunkSpan chunk = chunksOf(bytes).front();
  bytes[(chunk.start + chunk.end) / 2] ^= 1;
  temp_.write("walk.mcap", bytes);
  const OpenReplay replay(file());
  ASSERT_EQ(replay.status(), SPHC_OK) << replay.message();
  EXPECT_EQ(infoOf(replay).bad_chunk_count, 1u);
  EXPECT_EQ(infoOf(replay).acceleration_count, 0u);
}

TEST_F(Recorder, RefusesABadConfig) {
  const auto refusal = [&](auto change) {
    sphc_recorder_config config = recorderConfig();
    change(config);
    const OpenRecorder recorder(file(), config);
    EXPECT_EQ(recorder.status(), SPHC_E_ARGUMENT);
    return recorder.message();
  };
  EXPECT_THAT(refusal([](auto &c) { c.depth_codec = 0; }), HasSubstr("config.depth_codec"));
  EXPECT_THAT(refusal([](auto &c) { c.jpeg_quality = 101; }), HasSubstr("config.jpeg_quality"));
  EXPECT_THAT(refusal([](auto &c) { c.queue_slots = 1; }), HasSubstr("config.queue_slots"));
  EXPECT_THAT(refusal([](auto &c) { c.sync_ms = 1; }), HasSubstr("config.sync_ms"));
  EXPECT_THAT(refusal([](auto &c) { c.chunk_bytes = 1; }), HasSubstr("config.chunk_bytes"));
  sphc_recorder *none = nullptr;
  EXPECT_EQ(sphc_recorder_open(nullptr, nullptr, nullptr, &none, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_recorder_add(nullptr, nullptr, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_recorder_close(nullptr, nullptr), SPHC_OK);
  EXPECT_EQ(sphc_recorder_close(&none, nullptr), SPHC_OK);
}

// ---- crashes ----

TEST_F(Recorder, AFileThatWasCutInItsHeadIsCalledCut) {
  writeTinyMcap(file(), 2, config_);
  const std::string whole = temp_.read("walk.mcap");
  for (const size_t bytes : {8, 20, 300}) {
    temp_.write("cut.mcap", whole.substr(0, bytes));
    const OpenReplay replay(temp_ / "cut.mcap");
    EXPECT_EQ(replay.status(), SPHC_E_DEVICE);
    EXPECT_THAT(replay.message(), AllOf(HasSubstr("was cut before"), HasSubstr("copy it again"))) << bytes;
  }
}

TEST_F(Recorder, ACutFileIsReplayedUpToItsLastWholeChunk) {
  config_.chunk_bytes = 65536;
  writeTinyMcap(file(), 60, config_);
  const std::string whole = temp_.read("walk.mcap");
  const std::vector<ChunkSpan> chunks = chunksOf(whole);
  ASSERT_GE(chunks.size(), 5u);
  std::vector<size_t> cuts = {whole.size() - 1, whole.size() - 300};
  for (const ChunkSpan &chunk : chunks)
    for (const size_t cut : {chunk.start, chunk.start + 5, (chunk.start + chunk.end) / 2, chunk.end - 1, chunk.end})
      cuts.push_back(cut);
  for (uint32_t i = 1; i <= 40; ++i) cuts.push_back(i * 7919 * 613 % whole.size());
  for (const size_t cut : cuts) {
    temp_.write("cut.mcap", whole.substr(0, cut));
    uint32_t color = 0, depth = 0;
    for (const ChunkSpan &chunk : chunks)
      if (chunk.end <= cut) color += chunk.color, depth += chunk.depth;
    const sphc_replay_config tight = tightConfig();
    const OpenReplay replay(temp_ / "cut.mcap", nullptr, &tight);
    if (color == 0) {
      EXPECT_EQ(replay.status(), SPHC_E_DEVICE) << cut;
      EXPECT_STRNE(replay.message().c_str(), "");
      continue;
    }
    ASSERT_EQ(replay.status(), SPHC_OK) << cut << replay.message();
    const sphc_replay_info info = infoOf(replay);
    EXPECT_EQ(info.color_count, color) << cut;
    EXPECT_EQ(info.depth_count, depth) << cut;
    EXPECT_EQ(info.bad_chunk_count, 0u);
    EXPECT_EQ(info.is_cut, cut < chunks.back().end + 9 ? 1u : info.is_cut);
    expectTinyFrame(replay, sphc_replay_frame_count(replay.get()) - 1);
  }
}

// A power cut may leave a file as long as it should be, with zeros or old bytes at its end.
TEST_F(Recorder, GarbageAtTheEndIsLeftOut) {
  config_.chunk_bytes = 65536;
  writeTinyMcap(file(), 60, config_);
  const std::string whole = temp_.read("walk.mcap");
  const std::vector<ChunkSpan> chunks = chunksOf(whole);
  const ChunkSpan &last = chunks[3];
  std::string torn = whole.substr(0, last.end);
  std::fill(torn.begin() + static_cast<ptrdiff_t>(last.end) - 4096, torn.end(), '\0');
  temp_.write("torn.mcap", torn + std::string(10000, '\0'));
  const OpenReplay replay(temp_ / "torn.mcap");
  ASSERT_EQ(replay.status(), SPHC_OK) << replay.message();
  const sphc_replay_info info = infoOf(replay);
  EXPECT_EQ(info.color_count, chunks[0].color + chunks[1].color + chunks[2].color);
  EXPECT_EQ(info.bad_chunk_count, 1u);
  EXPECT_EQ(info.is_cut, 1u);
}

TEST_F(Recorder, AChangedByteIsNoticedAndTheRestIsRead) {
  config_.chunk_bytes = 65536;
  writeTinyMcap(file(), 30, config_);
  std::string bytes = temp_.read("walk.mcap");
  const ChunkSpan first = chunksOf(bytes)[0];
  bytes[(first.start + first.end) / 2] ^= 4;
  temp_.write("changed.mcap", bytes);
  const OpenReplay replay(temp_ / "changed.mcap");
  ASSERT_EQ(replay.status(), SPHC_OK) << replay.message();
  sphc_localizer_frame frame;
  sphc_message message{};
  EXPECT_EQ(sphc_replay_read_frame(replay.get(), 0, &frame, &message), SPHC_E_DEVICE);
  EXPECT_THAT(message.text, AllOf(HasSubstr("changed.mcap"), HasSubstr("checksum")));
  expectTinyFrame(replay, 29);
}

// Nobody reads a pose's bytes again: its chunk is checked at once.
TEST_F(Recorder, AChangedPoseIsNotBelieved) {
  config_.chunk_bytes = 65536;
  writeTinyMcap(file(), 30, config_);
  std::string bytes = temp_.read("walk.mcap");
  const sphc_rigid pose = tinyPose(3);
  const size_t at = bytes.find(std::string(reinterpret_cast<const char *>(&pose.t_m[0]), 8));
  ASSERT_NE(at, std::string::npos);
  ASSERT_LT(at, chunksOf(bytes)[0].end);
  bytes[at + 6] ^= 1;
  temp_.write("changed.mcap", bytes);
  const OpenReplay before(file()), replay(temp_ / "changed.mcap");
  ASSERT_EQ(replay.status(), SPHC_OK) << replay.message();
  EXPECT_EQ(infoOf(before).bad_chunk_count, 0u);
  EXPECT_EQ(infoOf(replay).bad_chunk_count, 1u);
  EXPECT_LT(infoOf(replay).pose_count, infoOf(before).pose_count);
  sphc_rigid read;
  ASSERT_EQ(sphc_replay_pose(before.get(), 3, &read), SPHC_OK);
  EXPECT_EQ(sphc_replay_pose(replay.get(), 3, &read), SPHC_NOT_LOCALIZED);
  ASSERT_EQ(sphc_replay_pose(replay.get(), 29, &read), SPHC_OK);
  EXPECT_EQ(read.t_m[0], tinyPose(29).t_m[0]);
}

// All that is read of a recording; nothing where a change of its bytes is told.
std::string readAll(const std::string &path) {
  const sphc_replay_config tight = tightConfig();
  const OpenReplay replay(path, nullptr, &tight);
  if (replay.status() != SPHC_OK) return "";
  const sphc_replay_info info = infoOf(replay);
  if (info.bad_chunk_count > 0 || info.is_cut || info.lost_count > 0 || info.bad_pose_count > 0) return "";
  std::string all;
  const auto add = [&all](const void *bytes, size_t size) { all.append(static_cast<const char *>(bytes), size); };
  sphc_rig rig{};
  EXPECT_EQ(sphc_replay_rig(replay.get(), &rig), SPHC_OK);
  add(&rig, sizeof rig);
  for (uint32_t i = 0; i < sphc_replay_frame_count(replay.get()); ++i) {
    sphc_localizer_frame frame;
    if (sphc_replay_read_frame(replay.get(), i, &frame, nullptr) != SPHC_OK) return "";
    const int64_t head[] = {frame.sequence, frame.color_time_ns, frame.depth_time_ns};
    add(head, sizeof head);
    add(frame.color.data, size_t{frame.color.stride_bytes} * frame.color.height);
    add(frame.depth.data, size_t{frame.depth.stride_bytes} * frame.depth.height);
  }
  for (uint32_t i = 0; i < info.pose_count; ++i) {
    int64_t time_ns = 0;
    sphc_rigid pose;
    if (sphc_replay_recorded_pose(replay.get(), i, &time_ns, &pose) != SPHC_OK) return "";
    add(&time_ns, sizeof time_ns);
    add(&pose, sizeof pose);
  }
  return all;
}

TEST_F(Recorder, AFlippedBitIsFoundOrHasNoEffect) {
  config_.chunk_bytes = 65536;
  writeTinyMcap(file(), 3, config_);
  const std::string whole = temp_.read("walk.mcap"), truth = readAll(file());
  ASSERT_GT(truth.size(), 3u * 1000);
  uint32_t found = 0, without_effect = 0;
  for (size_t at = 0; at < whole.size(); at += 5) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ (1 << at % 8));
    temp_.write("changed.mcap", changed);
    const std::string read = readAll(temp_ / "changed.mcap");
    ASSERT_TRUE(read.empty() || read == truth) << "byte " << at << " of " << whole.size();
    ++(read.empty() ? found : without_effect);
  }
  EXPECT_GT(found, 500u);
  EXPECT_GT(without_effect, 50u);  // the index behind the data
}

TEST_F(Recorder, AChangedHeadIsRefusedWithACure) {
  writeTinyMcap(file(), 3, config_);
  std::string bytes = temp_.read("walk.mcap");
  const size_t topic = bytes.find("/pose");
  ASSERT_NE(topic, std::string::npos);
  bytes[topic + 1] ^= 1;
  temp_.write("changed.mcap", bytes);
  const OpenReplay replay(temp_ / "changed.mcap");
  EXPECT_EQ(replay.status(), SPHC_E_DEVICE);
  EXPECT_THAT(replay.message(), AllOf(HasSubstr("changed.mcap"), HasSubstr("copy it again")));
}

TEST_F(Recorder, WhatFollowsItsEndIsRefusedWithACure) {
  writeTinyMcap(file(), 3, config_);
  const std::string whole = temp_.read("walk.mcap"), end = "its end is at byte " + std::to_string(whole.size());
  for (const std::string &more : {std::string(1, '\0'), std::string("more"), whole}) {
    temp_.write("joined.mcap", whole + more);
    const OpenReplay replay(temp_ / "joined.mcap");
    EXPECT_EQ(replay.status(), SPHC_E_DEVICE);
    EXPECT_THAT(replay.message(),
                AllOf(HasSubstr("joined.mcap: " + end + ", and " + std::to_string(more.size()) + " bytes follow"),
                      HasSubstr("copy it again")));
  }
}

// As a tool leaves it that drops metadata and makes no checksum.
TEST_F(Recorder, ATypeOfOursTellsARecordingWithoutMetadata) {
  writeTinyMcap(file(), 3, config_);
  std::string bytes = temp_.read("walk.mcap");
  const std::string name("\x0B\0\0\0spherecloud", 15);
  for (size_t at = bytes.find(name); at != std::string::npos; at = bytes.find(name, at + 1)) bytes[at + 4] = 'S';
  const size_t data_end = bytes.find(std::string("\x0F\x04\0\0\0\0\0\0\0", 9), chunksOf(bytes).back().end);
  bytes.replace(data_end + 9, 4, 4, '\0');
  temp_.write("filtered.mcap", bytes);
  EXPECT_EQ(readAll(temp_ / "filtered.mcap"), readAll(file()));
}

// As "mcap compress" leaves them; nothing of them is decompressed.
TEST_F(Recorder, ChunksThatAnotherToolCompressedAreRefusedWithACure) {
  writeTinyMcap(file(), 3, config_);
  const std::string whole = temp_.read("walk.mcap");
  std::string other;
  size_t at = 0;
  for (const ChunkSpan &chunk : chunksOf(whole)) {
    constexpr size_t kBeforeName = 9 + 28;
    const uint64_t bytes = chunk.end - chunk.start - 9 + 4;
    std::string head = whole.substr(chunk.start, kBeforeName) + std::string("\x04\0\0\0zstd", 8);
    std::memcpy(&head[1], &bytes, sizeof bytes);
    other += whole.substr(at, chunk.start - at) + head;
    at = chunk.start + kBeforeName + 4;
  }
  temp_.write("other.mcap", other + whole.substr(at));
  const OpenReplay replay(temp_ / "other.mcap");
  EXPECT_EQ(replay.status(), SPHC_E_UNSUPPORTED);
  EXPECT_THAT(replay.message(), HasSubstr("other.mcap: another tool compressed its chunks (zstd); \"mcap compress "
                                          "--compression none\" undoes that"));
}

TEST_F(Recorder, AnotherBeginningIsNamed) {
  writeTinyMcap(file(), 3, config_);
  std::string bytes = temp_.read("walk.mcap");
  bytes[1] = 'm';
  temp_.write("changed.mcap", bytes);
  const OpenReplay replay(temp_ / "changed.mcap");
  EXPECT_EQ(replay.status(), SPHC_E_DEVICE);
  EXPECT_THAT(replay.message(),
              AllOf(HasSubstr("changed.mcap: is no recording by its first bytes"), HasSubstr("copy it again")));
}

// As files of before, and of writers that make none.
TEST_F(Recorder, AFileWithoutAChecksumOfItsDataIsRead) {
  writeTinyMcap(file(), 3, config_);
  std::string bytes = temp_.read("walk.mcap");
  const std::string head = std::string("\x0F\x04", 2) + std::string(7, '\0');
  const size_t data_end = bytes.find(head, chunksOf(bytes).back().end);
  ASSERT_NE(data_end, std::string::npos);
  ASSERT_NE(bytes.substr(data_end + head.size(), 4), std::string(4, '\0'));
  bytes.replace(data_end + head.size(), 4, 4, '\0');
  temp_.write("before.mcap", bytes);
  EXPECT_EQ(readAll(temp_ / "before.mcap"), readAll(file()));
}

TEST_F(Recorder, AnAbandonedRecordingCountsAsCutAndKeepsAll) {
  sphc_recorder *recorder = nullptr;
  const sphc_rig calibration = tinyCalibration();
  ASSERT_EQ(sphc_recorder_open(file().c_str(), &calibration, &config_, &recorder, nullptr), SPHC_OK);
  addTinyFrames(recorder, 5);
  sphc_recorder_abandon(&recorder);
  EXPECT_EQ(recorder, nullptr);
  sphc_recorder_abandon(&recorder);
  sphc_recorder_abandon(nullptr);
  const OpenReplay replay(file());
  ASSERT_EQ(replay.status(), SPHC_OK) << replay.message();
  EXPECT_EQ(infoOf(replay).is_cut, 1u);
  EXPECT_EQ(infoOf(replay).color_count, 5u);
}

TEST_F(Recorder, AKilledRecordingIsReplayed) {
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    config_.chunk_bytes = 65536;
    OpenRecorder recorder(file(), config_);
    for (uint32_t i = 0;; ++i) {
      const TinyImages images(i);
      for (const sphc_stream stream : {SPHC_STREAM_COLOR, SPHC_STREAM_DEPTH}) {
        const sphc_capture capture = tinyCapture(i, stream, images);
        if (sphc_recorder_add(recorder.get(), &capture, nullptr) != SPHC_OK) _exit(1);
      }
    }
  }
  const auto bytes = [&] { return std::filesystem::exists(file()) ? std::filesystem::file_size(file()) : 0; };
  int state = 0;
  while (bytes() < 300000) {
    ASSERT_EQ(waitpid(child, &state, WNOHANG), 0) << "it ended by itself";
    usleep(1000);
  }
  ASSERT_EQ(kill(child, SIGKILL), 0);
  ASSERT_EQ(waitpid(child, &state, 0), child);
  ASSERT_TRUE(WIFSIGNALED(state));
  const sphc_replay_config tight = tightConfig();
  const OpenReplay replay(file(), nullptr, &tight);
  ASSERT_EQ(replay.status(), SPHC_OK) << replay.message();
  EXPECT_EQ(infoOf(replay).is_cut, 1u);
  EXPECT_EQ(infoOf(replay).lost_count, 0u);
  const uint32_t frames = sphc_replay_frame_count(replay.get());
  ASSERT_GT(frames, 10u);
  for (uint32_t i = 0; i < frames; ++i) expectTinyFrame(replay, i);  // from 0 on, none missing
}

TEST_F(Recorder, AFullDiskEndsTheRecordingAndKeepsWhatIsThere) {
  config_.chunk_bytes = 65536;
  {
    const FileSizeLimit limit(200000);
    OpenRecorder recorder(file(), config_);
    sphc_message message{};
    sphc_status status = SPHC_OK;
    for (uint32_t i = 0; i < 100000 && status >= 0; ++i) {
      const TinyImages images(i);
      const sphc_capture color = tinyCapture(i, SPHC_STREAM_COLOR, images);
      const sphc_capture depth = tinyCapture(i, SPHC_STREAM_DEPTH, images);
      status = sphc_recorder_add(recorder.get(), &color, &message);
      if (status >= 0) status = sphc_recorder_add(recorder.get(), &depth, &message);
    }
    EXPECT_EQ(status, SPHC_E_DEVICE);
    EXPECT_THAT(message.text, AllOf(HasSubstr("walk.mcap"), HasSubstr("make room")));
    const sphc_recorder_statistics statistics = statisticsOf(recorder.get());
    EXPECT_GT(statistics.dropped_count, 0u) << "the chunk that did not fit";
    EXPECT_EQ(recorder.close(), SPHC_E_DEVICE);
    const sphc_replay_config tight = tightConfig();
    const OpenReplay replay(file(), nullptr, &tight);
    ASSERT_EQ(replay.status(), SPHC_OK) << replay.message();
    EXPECT_EQ(infoOf(replay).color_count, statistics.color_count);
    EXPECT_EQ(infoOf(replay).depth_count, statistics.depth_count);
    EXPECT_EQ(infoOf(replay).is_cut, 1u);
    EXPECT_EQ(infoOf(replay).bad_chunk_count, 0u);
    expectTinyFrame(replay, sphc_replay_frame_count(replay.get()) - 1);
  }
}

TEST_F(Recorder, ADiskThatFillsAtTheVeryEndLeavesAReadableFile) {
  writeTinyMcap(temp_ / "model.mcap", 10, config_);
  const std::string model = temp_.read("model.mcap");
  const FileSizeLimit limit(chunksOf(model).back().end + 1100);  // room for the data, not for the summary
  OpenRecorder recorder(file(), config_);
  addTinyFrames(recorder.get(), 10);
  EXPECT_EQ(recorder.close(), SPHC_E_DEVICE);
  const OpenReplay replay(file());
  ASSERT_EQ(replay.status(), SPHC_OK) << replay.message();
  EXPECT_EQ(sphc_replay_frame_count(replay.get()), 10u);
}

}  // namespace

}  // namespace sphc::contract
