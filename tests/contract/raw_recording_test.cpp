// The raw recording: written by the workstation, read by the C reader of devices.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "drivers/raw/raw.h"
#include "file_size_limit.h"
#include "host/recording/failure.h"
#include "host/recording/recording_reader.h"
#include "host/recording/writer_raw.h"
#include "tests/support/session.h"
#include "tests/support/spoiled_rigs.h"
#include "tests/support/temp_folder.h"
#include "tiny_mcap.h"

namespace sphc::contract {

namespace {

using recording::RawWriter;
using recording::RecordingReader;
using ::testing::HasSubstr;

constexpr size_t kHeaderBytes = 320, kHeadBytes = 88;

// The recording's bytes, wherever they are; `broken_at` is where the medium has a fault.
struct Medium {
  std::string bytes;
  uint64_t broken_at = UINT64_MAX;
};

int readMedium(void *user, uint64_t offset, void *out, size_t bytes) {
  const auto &medium = *static_cast<const Medium *>(user);
  if (offset + bytes > medium.bytes.size() || offset + bytes > medium.broken_at) return 1;
  std::memcpy(out, medium.bytes.data() + offset, bytes);
  return 0;
}

struct Opened {
  sphc_raw raw = {};
  sphc_status status = SPHC_OK;
  sphc_message message = {};
};

Opened open(Medium *medium) {
  Opened opened;
  opened.status = sphc_raw_open(&opened.raw, readMedium, medium, medium->bytes.size(), &opened.message);
  return opened;
}

struct ReadFrame {
  std::vector<uint16_t> memory;
  sphc_raw_frame recorded = {};
  sphc_status status = SPHC_OK;
  sphc_message message = {};
};

ReadFrame read(const sphc_raw &raw, uint32_t index) {
  ReadFrame frame;
  frame.memory.resize((raw.frame_bytes + 1) / 2);
  frame.status =
      sphc_raw_read_frame(&raw, index, frame.memory.data(), raw.frame_bytes, &frame.recorded, &frame.message);
  return frame;
}

void writeRaw(const std::string &from, const std::string &to, sphc_format format = SPHC_FORMAT_BGR8) {
  recording::ReaderOptions options;
  options.color_format = format;
  RecordingReader reader(from, options);
  RawWriter writer(to, reader.calibration(), format);
  for (uint32_t i = 0; i < reader.frameCount(); ++i) {
    const sphc_localizer_frame frame = reader.read(i);
    const std::optional<sphc_rigid> pose = reader.worldFromCamera(i);
    writer.add(frame, pose ? &*pose : nullptr);
  }
  writer.finish();
}

class RawRecording : public ::testing::Test {
 protected:
  void SetUp() override {
    writeTinyRecording(folder_ / "walk", 3);
    writeRaw(folder_ / "walk", folder_ / "walk.raw");
    medium_.bytes = folder_.read("walk.raw");
  }

  test::TempFolder folder_;
  Medium medium_;
};

bool sameImage(const sphc_image &a, const sphc_image &b) {
  return a.width == b.width && a.height == b.height && a.stride_bytes == b.stride_bytes && a.format == b.format &&
         std::memcmp(a.data, b.data, size_t{a.height} * a.stride_bytes) == 0;
}

// Frames and poses are those that the replay driver gives, to the bit.
void expectSame(const std::string &recorded, Medium *medium, sphc_format format = SPHC_FORMAT_BGR8) {
  sphc_replay_config config = replayConfig();
  config.color_format = format;
  const OpenReplay replay(recorded, nullptr, &config);
  ASSERT_EQ(replay.status(), SPHC_OK) << replay.message();
  const Opened opened = open(medium);
  ASSERT_EQ(opened.status, SPHC_OK) << opened.message.text;
  sphc_rig rig;
  ASSERT_EQ(sphc_replay_rig(replay.get(), &rig), SPHC_OK);
  EXPECT_EQ(std::memcmp(&opened.raw.rig, &rig, sizeof rig), 0);
  ASSERT_EQ(opened.raw.frame_count, sphc_replay_frame_count(replay.get()));
  for (uint32_t i = opened.raw.frame_count; i-- > 0;) {
    const ReadFrame raw = read(opened.raw, i);
    ASSERT_EQ(raw.status, SPHC_OK) << raw.message.text;
    sphc_localizer_frame frame;
    ASSERT_EQ(sphc_replay_read_frame(replay.get(), i, &frame, nullptr), SPHC_OK);
    EXPECT_EQ(raw.recorded.frame.struct_size, sizeof frame);
    EXPECT_EQ(raw.recorded.frame.sequence, frame.sequence);
    EXPECT_EQ(raw.recorded.frame.color_time_ns, frame.color_time_ns);
    EXPECT_EQ(raw.recorded.frame.depth_time_ns, frame.depth_time_ns);
    EXPECT_TRUE(sameImage(raw.recorded.frame.color, frame.color)) << i;
    EXPECT_TRUE(sameImage(raw.recorded.frame.depth, frame.depth)) << i;
    sphc_rigid pose;
    ASSERT_EQ(sphc_replay_pose(replay.get(), i, &pose) == SPHC_OK, raw.recorded.has_pose == 1);
    if (raw.recorded.has_pose) {
      EXPECT_EQ(std::memcmp(&raw.recorded.world_from_camera, &pose, sizeof pose), 0);
    }
    sphc_raw_frame head;
    ASSERT_EQ(sphc_raw_read_head(&opened.raw, i, &head, nullptr), SPHC_OK);
    EXPECT_EQ(head.frame.color_time_ns, frame.color_time_ns);
    EXPECT_EQ(head.frame.color.data, nullptr);
  }
}

TEST_F(RawRecording, IsTheFolderToTheBit) { expectSame(folder_ / "walk", &medium_); }

TEST_F(RawRecording, IsARecordingOfTheWorkstationToo) {
  expectSame(folder_ / "walk.raw", &medium_);
  const OpenReplay replay(folder_ / "walk.raw");
  const sphc_replay_info info = infoOf(replay);
  EXPECT_EQ(info.layout, SPHC_REPLAY_RAW);
  EXPECT_EQ(info.pose_count, 3u);
  std::string bytes = medium_.bytes;
  bytes[bytes.size() - 1] ^= 1;
  folder_.write("changed.raw", bytes);
  const OpenReplay changed(folder_ / "changed.raw");
  sphc_localizer_frame frame;
  sphc_message message = {};
  EXPECT_EQ(sphc_replay_read_frame(changed.get(), 1, &frame, &message), SPHC_OK) << message.text;
  EXPECT_EQ(sphc_replay_read_frame(changed.get(), 2, &frame, &message), SPHC_E_DEVICE);
  EXPECT_THAT(message.text, ::testing::AllOf(HasSubstr("changed.raw (colour 2)"), HasSubstr("checksum")));
}

TEST_F(RawRecording, IsTheFileToTheBit) {
  writeTinyMcap(folder_ / "walk.mcap", 4, recorderConfig());
  for (const sphc_format format : {SPHC_FORMAT_BGR8, SPHC_FORMAT_RGB8, SPHC_FORMAT_GRAY8}) {
    const std::string name = "walk" + std::to_string(format) + ".raw";
    writeRaw(folder_ / "walk.mcap", folder_ / name, format);
    Medium medium{folder_.read(name)};
    expectSame(folder_ / "walk.mcap", &medium, format);
  }
}

// On a device nothing asks how far apart the two are, and depth of the next frame may be nearer.
TEST_F(RawRecording, AFrameKeepsItsDepthHoweverLateItIs) {
  constexpr uint32_t kFrames = 4;
  constexpr int64_t kLateNs = kPeriodNs * 12 / 5;
  static_assert(kLateNs > 20000000);
  RawWriter writer(folder_ / "late.raw", tinyCalibration(), SPHC_FORMAT_BGR8);
  for (uint32_t i = 0; i < kFrames; ++i) {
    const TinyImages images(i);
    sphc_localizer_frame frame = tinyFrame(i, images);
    frame.depth_time_ns = frame.color_time_ns + kLateNs;
    writer.add(frame, nullptr);
  }
  writer.finish();
  recording::ReaderOptions options;
  for (const uint32_t step : {1u, 2u}) {
    options.selection.step = step;
    RecordingReader reader(folder_ / "late.raw", options);
    ASSERT_EQ(reader.frameCount(), kFrames / step);
    for (uint32_t i = 0; i < reader.frameCount(); ++i) {
      const sphc_localizer_frame frame = reader.read(i);
      EXPECT_EQ(frame.depth_time_ns, frame.color_time_ns + kLateNs);
      EXPECT_EQ(static_cast<const uint16_t *>(frame.depth.data)[0], tinyDepth(step * i, 0, 0));
    }
  }
}

TEST_F(RawRecording, KnowsWhereThereIsNoPose) {
  std::filesystem::remove(folder_ / "walk/groundtruth.txt");
  writeRaw(folder_ / "walk", folder_ / "lost.raw");
  Medium medium{folder_.read("lost.raw")};
  expectSame(folder_ / "walk", &medium);
  EXPECT_EQ(read(open(&medium).raw, 0).recorded.has_pose, 0u);
}

// The layout that docs/recording.md promises: a reader of somebody else's finds what it says where it says.
TEST_F(RawRecording, HasTheDocumentedLayout) {
  const auto number = [&](size_t at, size_t bytes) {
    uint64_t value = 0;
    for (size_t i = bytes; i-- > 0;) value = value << 8 | static_cast<uint8_t>(medium_.bytes[at + i]);
    return value;
  };
  const size_t frame_bytes = kHeadBytes + kDepthWidth * kDepthHeight * 2 + kColorWidth * kColorHeight * 3;
  ASSERT_EQ(medium_.bytes.size(), kHeaderBytes + 3 * frame_bytes);
  EXPECT_EQ(medium_.bytes.substr(0, 8), "SPHC-RAW");
  EXPECT_EQ(number(8, 4), 1u);
  EXPECT_EQ(number(12, 4), 3u);
  EXPECT_EQ(number(16, 4), static_cast<uint64_t>(SPHC_FORMAT_BGR8));
  EXPECT_EQ(number(24 + 4, 4), kColorWidth);
  EXPECT_EQ(number(136 + 8, 4), kDepthHeight);
  const size_t second = kHeaderBytes + frame_bytes;
  EXPECT_EQ(number(second, 4), 1u);
  EXPECT_EQ(number(second + 4, 4), 1u);
  EXPECT_EQ(number(second + 8, 8), static_cast<uint64_t>(kFirstNs + kPeriodNs));
  EXPECT_EQ(number(second + kHeadBytes, 2), tinyDepth(1, 0, 0));
  EXPECT_EQ(number(second + kHeadBytes + kDepthWidth * kDepthHeight * 2, 1), tinyColor(1, 0, 0, 0));
}

TEST_F(RawRecording, RefusesEveryTruncation) {
  const std::string whole = medium_.bytes;
  for (size_t bytes = 0; bytes < whole.size(); ++bytes) {
    medium_.bytes = whole.substr(0, bytes);
    const Opened opened = open(&medium_);
    ASSERT_EQ(opened.status, SPHC_E_ARGUMENT) << bytes;
    ASSERT_STRNE(opened.message.text, "");
    ASSERT_EQ(opened.raw.read, nullptr);
  }
  medium_.bytes = whole + "x";
  EXPECT_EQ(open(&medium_).status, SPHC_E_ARGUMENT) << "one byte more";
}

TEST_F(RawRecording, RefusesEveryFlippedBitOfTheHeader) {
  for (size_t at = 0; at < kHeaderBytes; ++at)
    for (int bit = 0; bit < 8; ++bit) {
      medium_.bytes[at] ^= static_cast<char>(1 << bit);
      const Opened opened = open(&medium_);
      ASSERT_EQ(opened.status, SPHC_E_ARGUMENT) << at;
      ASSERT_STRNE(opened.message.text, "");
      medium_.bytes[at] ^= static_cast<char>(1 << bit);
    }
  EXPECT_EQ(open(&medium_).status, SPHC_OK);
}

uint32_t crcOf(const std::string &bytes) {
  uint32_t crc = ~0u;
  for (const char c : bytes) {
    crc ^= static_cast<uint8_t>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? crc >> 1 ^ 0xEDB88320u : crc >> 1;
  }
  return ~crc;
}

// The checksum of a part, which is its last word, is right again.
void seal(std::string *bytes, size_t begin, size_t count) {
  const uint32_t crc = crcOf(bytes->substr(begin, count - 4));
  std::memcpy(bytes->data() + begin + count - 4, &crc, sizeof crc);
}

// With another value in a part, at a place of it.
template <typename Value>
std::string changed(std::string bytes, size_t begin, size_t count, size_t at, Value value) {
  std::memcpy(bytes.data() + begin + at, &value, sizeof value);
  seal(&bytes, begin, count);
  return bytes;
}

TEST_F(RawRecording, RefusesAHeaderThatNobodyWritesWhereItsChecksumIsRight) {
  const struct {
    size_t at;
    uint32_t word;
    const char *message;
  } wrong[] = {{8, 2, "not of version 1"},
               {16, SPHC_FORMAT_DEPTH16, "colour format is not known"},
               {20, 1, "the header has changed"},
               {312, 1, "the header has changed"}};
  for (const auto &each : wrong) {
    Medium medium{changed(medium_.bytes, 0, kHeaderBytes, each.at, each.word)};
    const Opened opened = open(&medium);
    EXPECT_EQ(opened.status, SPHC_E_ARGUMENT) << each.at;
    EXPECT_THAT(opened.message.text, HasSubstr(each.message));
  }
}

TEST_F(RawRecording, RefusesAPoseThatIsNoneWhereItsChecksumIsRight) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), far = 1e10;
  constexpr size_t kHasPoseAt = 4, kRotationAt = 24, kOffsetAt = 56;
  const auto with = [&](size_t at, auto value) {
    return changed(medium_.bytes, kHeaderBytes, kHeadBytes, at, value);
  };
  for (const std::string &bytes : {with(kHasPoseAt, uint32_t{2}), with(kRotationAt, nan), with(kRotationAt, 2.0),
                                   with(kOffsetAt, nan), with(kOffsetAt, far), with(kOffsetAt, -far)}) {
    Medium medium{bytes};
    const ReadFrame frame = read(open(&medium).raw, 0);
    EXPECT_EQ(frame.status, SPHC_E_DEVICE);
    EXPECT_THAT(frame.message.text, HasSubstr("a frame's pose is none"));
  }
  Medium sound{with(kOffsetAt, 1.0)};
  EXPECT_EQ(read(open(&sound).raw, 0).status, SPHC_OK);
}

TEST_F(RawRecording, RefusesARigAsAllDo) {
  const sphc_rig good = open(&medium_).raw.rig;
  for (const test::SpoiledRig &spoiled : test::spoiledRigs()) {
    sphc_rig rig = good;
    spoiled.spoil(&rig);
    std::memcpy(medium_.bytes.data() + 24, &rig, sizeof rig);  // laid out as in memory, on little-endian machines
    seal(&medium_.bytes, 0, kHeaderBytes);
    const Opened opened = open(&medium_);
    EXPECT_EQ(opened.status, SPHC_E_ARGUMENT);
    EXPECT_STREQ(opened.message.text, spoiled.message);
  }
}

TEST_F(RawRecording, NoticesEveryFlippedByteOfAFrameAndReadsTheOthers) {
  const Opened opened = open(&medium_);
  ASSERT_EQ(opened.status, SPHC_OK);
  const size_t start = kHeaderBytes + opened.raw.frame_bytes;
  for (size_t i = 0; i < opened.raw.frame_bytes; i += i < kHeadBytes ? 1 : 13) {
    medium_.bytes[start + i] ^= 0x10;
    const ReadFrame changed = read(opened.raw, 1);
    ASSERT_EQ(changed.status, SPHC_E_DEVICE) << i;
    ASSERT_EQ(changed.recorded.frame.struct_size, 0u) << i << ": what is refused leaves the output alone";
    ASSERT_THAT(changed.message.text, HasSubstr("checksum"));
    medium_.bytes[start + i] ^= 0x10;
  }
  medium_.bytes[start + 40] ^= 1;
  EXPECT_EQ(read(opened.raw, 0).status, SPHC_OK);
  EXPECT_EQ(read(opened.raw, 2).status, SPHC_OK);
}

TEST_F(RawRecording, TellsAMediumThatFails) {
  medium_.broken_at = 100;
  EXPECT_EQ(open(&medium_).status, SPHC_E_DEVICE);
  medium_.broken_at = kHeaderBytes + 1000;
  const Opened opened = open(&medium_);
  ASSERT_EQ(opened.status, SPHC_OK);
  const ReadFrame frame = read(opened.raw, 0);
  EXPECT_EQ(frame.status, SPHC_E_DEVICE);
  EXPECT_THAT(frame.message.text, HasSubstr("cannot be read"));
}

TEST_F(RawRecording, HasNoFrameWhereItDidNotOpen) {
  medium_.bytes.pop_back();
  const Opened opened = open(&medium_);
  ASSERT_EQ(opened.status, SPHC_E_ARGUMENT);
  EXPECT_EQ(opened.raw.frame_count, 0u);
  sphc_raw_frame frame;
  EXPECT_EQ(sphc_raw_read_head(&opened.raw, 0, &frame, nullptr), SPHC_E_ARGUMENT);
}

TEST_F(RawRecording, ChecksItsArguments) {
  sphc_raw raw;
  EXPECT_EQ(sphc_raw_open(nullptr, readMedium, &medium_, medium_.bytes.size(), nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_raw_open(&raw, nullptr, &medium_, medium_.bytes.size(), nullptr), SPHC_E_ARGUMENT);
  ASSERT_EQ(sphc_raw_open(&raw, readMedium, &medium_, medium_.bytes.size(), nullptr), SPHC_OK);
  std::vector<uint16_t> memory(raw.frame_bytes);
  sphc_raw_frame frame;
  auto *const odd = reinterpret_cast<uint8_t *>(memory.data()) + 1;
  EXPECT_EQ(sphc_raw_read_frame(&raw, 3, memory.data(), raw.frame_bytes, &frame, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_raw_read_frame(&raw, 0, memory.data(), raw.frame_bytes - 1, &frame, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_raw_read_frame(&raw, 0, odd, raw.frame_bytes, &frame, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_raw_read_frame(&raw, 0, nullptr, raw.frame_bytes, &frame, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_raw_read_frame(nullptr, 0, memory.data(), raw.frame_bytes, &frame, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_raw_read_head(&raw, 3, &frame, nullptr), SPHC_E_ARGUMENT);
}

TEST_F(RawRecording, IsWrittenWholeOrNotAtAll) {
  const TinyImages images(0);
  const sphc_localizer_frame frame = tinyFrame(0, images);
  const std::string path = folder_ / "new.raw";
  {
    RawWriter writer(path, tinyCalibration(), SPHC_FORMAT_BGR8);
    writer.add(frame, nullptr);
    EXPECT_FALSE(std::filesystem::exists(path));
    EXPECT_TRUE(std::filesystem::exists(path + ".unfinished"));
    EXPECT_THAT([&] { RawWriter(path, tinyCalibration(), SPHC_FORMAT_BGR8); },
                testing::ThrowsMessage<recording::Failure>(HasSubstr("new.raw.unfinished: is there")));
  }
  EXPECT_FALSE(std::filesystem::exists(path + ".unfinished")) << "given up";
  EXPECT_THROW(RawWriter(folder_ / "walk.raw", tinyCalibration(), SPHC_FORMAT_BGR8), recording::Failure);
  EXPECT_EQ(folder_.read("walk.raw"), medium_.bytes) << "nothing is overwritten";
}

TEST_F(RawRecording, AFullDiskAtItsBeginningLeavesNothing) {
  const std::string path = folder_ / "new.raw";
  const FileSizeLimit limit(100);
  EXPECT_THROW(RawWriter(path, tinyCalibration(), SPHC_FORMAT_BGR8), recording::Failure);
  EXPECT_FALSE(std::filesystem::exists(path + ".unfinished"));
}

// A frame from the raw recording gives the pose that the same frame from the replay driver gives, to the bit.
TEST(RawRecordingPoses, AreThoseOfTheReplay) {
  const test::TempFolder folder;
  const sphc_localizer_config config = test::sceneConfig();
  sphc_recording_writer *writer = nullptr;
  sphc_message message = {};
  ASSERT_EQ(sphc_recording_create((folder / "room").c_str(), &config.rig, &writer, &message), SPHC_OK)
      << message.text;
  for (uint32_t i = 0; i < 3; ++i) {
    const auto scene = test::sceneFrame(config, i);
    sphc_localizer_frame frame = scene->frame;
    frame.color_time_ns = frame.depth_time_ns = 1 + i * kPeriodNs;
    ASSERT_EQ(sphc_recording_add_frame(writer, &frame, &message), SPHC_OK) << message.text;
  }
  ASSERT_EQ(sphc_recording_close(&writer, &message), SPHC_OK);
  writeRaw(folder / "room", folder / "room.raw");
  Medium medium{folder.read("room.raw")};
  const Opened opened = open(&medium);
  const OpenReplay replay(folder / "room");
  test::Session replayed(config), raw(config);
  uint32_t localized = 0;
  for (uint32_t i = 0; i < 3; ++i) {
    sphc_localizer_frame frame;
    ASSERT_EQ(sphc_replay_read_frame(replay.get(), i, &frame, nullptr), SPHC_OK);
    const ReadFrame recorded = read(opened.raw, i);
    ASSERT_EQ(recorded.status, SPHC_OK) << recorded.message.text;
    sphc_localizer_result a = {}, b = {};
    a.struct_size = b.struct_size = sizeof a;
    const sphc_status status = replayed.process(frame, &a);
    EXPECT_EQ(raw.process(recorded.recorded.frame, &b), status);
    EXPECT_EQ(std::memcmp(&a.camera_from_map, &b.camera_from_map, sizeof a.camera_from_map), 0);
    EXPECT_EQ(std::memcmp(a.covariance, b.covariance, sizeof a.covariance), 0);
    localized += status == SPHC_OK;
  }
  EXPECT_GE(localized, 2u);
}

}  // namespace

}  // namespace sphc::contract
