// The writer of devices: what it writes is what its reader and the workstation read.
#include "drivers/raw/raw_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "drivers/raw/raw.h"
#include "tests/support/spoiled_rigs.h"
#include "tests/support/temp_folder.h"
#include "tiny_recording.h"

namespace sphc::contract {

namespace {

using ::testing::HasSubstr;

// A medium that takes bytes; from its `fails_at`th write on it is broken.
struct Storage {
  std::string bytes;
  uint32_t writes = 0, fails_at = UINT32_MAX;
  size_t most_bytes = 0;
};

int writeStorage(void *user, uint64_t offset, const void *bytes, size_t count) {
  auto &storage = *static_cast<Storage *>(user);
  if (storage.writes++ >= storage.fails_at) return 1;
  EXPECT_LE(offset, storage.bytes.size()) << "a gap";
  storage.bytes.resize(std::max<size_t>(storage.bytes.size(), offset + count));
  std::memcpy(storage.bytes.data() + offset, bytes, count);
  storage.most_bytes = std::max(storage.most_bytes, count);
  return 0;
}

int readStorage(void *user, uint64_t offset, void *out, size_t count) {
  const auto &storage = *static_cast<const Storage *>(user);
  if (offset + count > storage.bytes.size()) return 1;
  std::memcpy(out, storage.bytes.data() + offset, count);
  return 0;
}

class RawWriterOfDevices : public ::testing::Test {
 protected:
  void begin(sphc_format color_format = SPHC_FORMAT_BGR8) {
    const sphc_rig rig = tinyCalibration();
    ASSERT_EQ(sphc_raw_writer_begin(&writer_, writeStorage, &storage_, &rig, color_format, &message_), SPHC_OK)
        << message_.text;
  }
  sphc_status add(const sphc_localizer_frame &frame, const sphc_rigid *pose = nullptr) {
    message_ = {};
    return sphc_raw_writer_add(&writer_, &frame, pose, &message_);
  }
  sphc_status addTiny(uint32_t i) {
    const TinyImages images(i);
    return add(tinyFrame(i, images));
  }
  sphc_status finish() { return sphc_raw_writer_finish(&writer_, &message_); }
  sphc_status open(sphc_raw *raw) {
    return sphc_raw_open(raw, readStorage, &storage_, storage_.bytes.size(), &message_);
  }
  // Its images live in memory_.
  sphc_raw_frame read(uint32_t index) {
    sphc_raw raw;
    sphc_raw_frame recorded = {};
    EXPECT_EQ(open(&raw), SPHC_OK) << message_.text;
    memory_.resize((raw.frame_bytes + 1) / 2);
    EXPECT_EQ(sphc_raw_read_frame(&raw, index, memory_.data(), raw.frame_bytes, &recorded, &message_), SPHC_OK)
        << message_.text;
    return recorded;
  }

  Storage storage_;
  sphc_raw_writer writer_ = {};
  sphc_message message_ = {};
  std::vector<uint16_t> memory_;
};

// The same pixels with rows that are further apart.
struct Padded {
  Padded(const sphc_image &packed, uint32_t more_bytes) : image(packed) {
    image.stride_bytes += more_bytes;
    bytes.assign(size_t{image.stride_bytes} * image.height, 0xA5);
    for (uint32_t y = 0; y < image.height; ++y)
      std::memcpy(bytes.data() + size_t{y} * image.stride_bytes,
                  static_cast<const uint8_t *>(packed.data) + size_t{y} * packed.stride_bytes, packed.stride_bytes);
    image.data = bytes.data();
  }
  sphc_image image;
  std::vector<uint8_t> bytes;
};

TEST_F(RawWriterOfDevices, WritesWhatItsReaderReads) {
  begin();
  const TinyImages images(3);
  const Padded color(images.colorImage(), 5), depth(images.depthImage(), 24);
  sphc_localizer_frame frame = tinyFrame(3, images);
  frame.color = color.image;
  frame.depth = depth.image;
  const sphc_rigid pose = tinyPose(3);
  ASSERT_EQ(add(frame, &pose), SPHC_OK) << message_.text;
  ASSERT_EQ(finish(), SPHC_OK);
  EXPECT_EQ(storage_.bytes.size(), 320 + writer_.frame_bytes);
  const sphc_raw_frame recorded = read(0);
  EXPECT_EQ(recorded.frame.sequence, 3u);
  EXPECT_EQ(recorded.frame.color_time_ns, frame.color_time_ns);
  EXPECT_EQ(recorded.frame.depth_time_ns, frame.depth_time_ns);
  ASSERT_EQ(recorded.has_pose, 1u);
  EXPECT_EQ(std::memcmp(&recorded.world_from_camera, &pose, sizeof pose), 0);
  EXPECT_EQ(std::memcmp(recorded.frame.color.data, images.color.data(), images.color.size()), 0);
  EXPECT_EQ(std::memcmp(recorded.frame.depth.data, images.depth.data(), 2 * images.depth.size()), 0);
}

TEST_F(RawWriterOfDevices, WritesGreyForTheWorkstation) {
  begin(SPHC_FORMAT_GRAY8);
  for (uint32_t i = 0; i < 2; ++i) {
    const TinyImages images(i);
    sphc_localizer_frame frame = tinyFrame(i, images);
    frame.color = {images.color.data(), kColorWidth, kColorHeight, kColorWidth, SPHC_FORMAT_GRAY8};
    ASSERT_EQ(add(frame), SPHC_OK) << message_.text;
  }
  ASSERT_EQ(finish(), SPHC_OK);
  const test::TempFolder folder;
  folder.write("walk.raw", storage_.bytes);
  sphc_replay_config config = replayConfig();
  config.color_format = SPHC_FORMAT_GRAY8;
  const OpenReplay replay(folder / "walk.raw", nullptr, &config);
  ASSERT_EQ(replay.status(), SPHC_OK) << replay.message();
  ASSERT_EQ(sphc_replay_frame_count(replay.get()), 2u);
  sphc_localizer_frame frame;
  ASSERT_EQ(sphc_replay_read_frame(replay.get(), 1, &frame, &message_), SPHC_OK) << message_.text;
  EXPECT_EQ(std::memcmp(frame.color.data, TinyImages(1).color.data(), size_t{kColorWidth} * kColorHeight), 0);
}

TEST_F(RawWriterOfDevices, WritesInSmallPieces) {
  begin();
  ASSERT_EQ(addTiny(0), SPHC_OK);
  EXPECT_EQ(storage_.most_bytes, 512u) << "of depth; a row of colour has less";
}

TEST_F(RawWriterOfDevices, CountsAtEachFinishAndGoesOn) {
  begin();
  sphc_raw raw;
  ASSERT_EQ(open(&raw), SPHC_OK);
  EXPECT_EQ(raw.frame_count, 0u);
  ASSERT_EQ(addTiny(0), SPHC_OK);
  ASSERT_EQ(finish(), SPHC_OK);
  const size_t counted = storage_.bytes.size();
  ASSERT_EQ(addTiny(1), SPHC_OK);
  EXPECT_EQ(open(&raw), SPHC_E_ARGUMENT) << "as after a power cut";
  EXPECT_THAT(message_.text, HasSubstr("never finished"));
  const std::string all = storage_.bytes;
  storage_.bytes.resize(counted);
  EXPECT_EQ(read(0).frame.color_time_ns, kFirstNs);
  storage_.bytes = all;
  ASSERT_EQ(finish(), SPHC_OK);
  EXPECT_EQ(read(1).frame.color_time_ns, kFirstNs + kPeriodNs);
}

TEST_F(RawWriterOfDevices, AFrameThatCouldNotBeWrittenIsNotCounted) {
  begin();
  ASSERT_EQ(addTiny(0), SPHC_OK);
  for (uint32_t writes = 0; writes < 3; ++writes) {
    storage_.fails_at = storage_.writes + writes;
    EXPECT_EQ(addTiny(1), SPHC_E_DEVICE);
    EXPECT_THAT(message_.text, HasSubstr("check the storage"));
  }
  EXPECT_EQ(finish(), SPHC_E_DEVICE);
  storage_.fails_at = UINT32_MAX;
  EXPECT_EQ(writer_.frame_count, 1u);
  ASSERT_EQ(addTiny(2), SPHC_OK);
  ASSERT_EQ(finish(), SPHC_OK);
  EXPECT_EQ(read(1).frame.sequence, 2u) << "in the place of the one that failed";
}

struct Spoiled {
  sphc_status status;
  const char *message;
  void (*spoil)(sphc_localizer_frame *frame, sphc_rigid *pose);
};

TEST_F(RawWriterOfDevices, RefusesAFrameByName) {
  static const Spoiled kAll[] = {
      {SPHC_E_IMAGE, "frame.color: data is null", [](auto *f, auto *) { f->color.data = nullptr; }},
      {SPHC_E_IMAGE, "frame.color: format", [](auto *f, auto *) { f->color.format = SPHC_FORMAT_RGB8; }},
      {SPHC_E_IMAGE, "frame.color: size", [](auto *f, auto *) { --f->color.height; }},
      {SPHC_E_IMAGE, "frame.color: stride_bytes", [](auto *f, auto *) { --f->color.stride_bytes; }},
      {SPHC_E_IMAGE, "frame.depth: data is null", [](auto *f, auto *) { f->depth.data = nullptr; }},
      {SPHC_E_IMAGE, "frame.depth: format", [](auto *f, auto *) { f->depth.format = SPHC_FORMAT_DEPTH_F32; }},
      {SPHC_E_IMAGE, "frame.depth: size", [](auto *f, auto *) { ++f->depth.width; }},
      {SPHC_E_IMAGE, "frame.depth: stride_bytes", [](auto *f, auto *) { f->depth.stride_bytes = 1; }},
      {SPHC_E_ARGUMENT, "frame.color_time_ns", [](auto *f, auto *) { f->color_time_ns = kFirstNs; }},
      {SPHC_E_ARGUMENT, "frame.depth_time_ns", [](auto *f, auto *) { f->depth_time_ns = kFirstNs; }},
      {SPHC_E_ARGUMENT, "frame has a time below 0", [](auto *f, auto *) { f->depth_time_ns = -1; }},
      {SPHC_E_ARGUMENT, "world_from_camera", [](auto *, auto *pose) { pose->q_wxyz[0] = 2; }},
      {SPHC_E_ARGUMENT, "world_from_camera",
       [](auto *, auto *pose) { pose->t_m[2] = std::numeric_limits<double>::quiet_NaN(); }},
      {SPHC_E_STRUCT_SIZE, "frame.struct_size", [](auto *f, auto *) { f->struct_size -= 8; }},
  };
  begin();
  ASSERT_EQ(addTiny(0), SPHC_OK);
  const std::string before = storage_.bytes;
  for (const Spoiled &spoiled : kAll) {
    const TinyImages images(1);
    sphc_localizer_frame frame = tinyFrame(1, images);
    sphc_rigid pose = tinyPose(1);
    spoiled.spoil(&frame, &pose);
    EXPECT_EQ(add(frame, &pose), spoiled.status) << spoiled.message;
    EXPECT_THAT(message_.text, ::testing::StartsWith(spoiled.message));
  }
  EXPECT_EQ(storage_.bytes, before);
  EXPECT_EQ(writer_.frame_count, 1u);
}

TEST_F(RawWriterOfDevices, RefusesARigAsAllDo) {
  for (const test::SpoiledRig &spoiled : test::spoiledRigs()) {
    sphc_rig rig = tinyCalibration();
    spoiled.spoil(&rig);
    EXPECT_EQ(sphc_raw_writer_begin(&writer_, writeStorage, &storage_, &rig, SPHC_FORMAT_BGR8, &message_),
              SPHC_E_ARGUMENT);
    EXPECT_STREQ(message_.text, spoiled.message);
  }
  EXPECT_EQ(storage_.bytes, "");
  EXPECT_EQ(addTiny(0), SPHC_E_ARGUMENT) << "not begun";
}

TEST_F(RawWriterOfDevices, ChecksItsArguments) {
  const sphc_rig rig = tinyCalibration();
  const TinyImages images(0);
  const sphc_localizer_frame frame = tinyFrame(0, images);
  const auto beginBy = [&](sphc_raw_writer *writer, sphc_raw_write write, const sphc_rig *rig_or_null,
                           sphc_format format) {
    return sphc_raw_writer_begin(writer, write, &storage_, rig_or_null, format, nullptr);
  };
  EXPECT_EQ(beginBy(nullptr, writeStorage, &rig, SPHC_FORMAT_BGR8), SPHC_E_ARGUMENT);
  EXPECT_EQ(beginBy(&writer_, nullptr, &rig, SPHC_FORMAT_BGR8), SPHC_E_ARGUMENT);
  EXPECT_EQ(beginBy(&writer_, writeStorage, nullptr, SPHC_FORMAT_BGR8), SPHC_E_ARGUMENT);
  EXPECT_EQ(beginBy(&writer_, writeStorage, &rig, SPHC_FORMAT_NV12), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_raw_writer_add(nullptr, &frame, nullptr, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_raw_writer_add(&writer_, &frame, nullptr, nullptr), SPHC_E_ARGUMENT) << "not begun";
  EXPECT_EQ(sphc_raw_writer_finish(nullptr, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(finish(), SPHC_E_ARGUMENT) << "not begun";
  storage_.fails_at = 0;
  EXPECT_EQ(beginBy(&writer_, writeStorage, &rig, SPHC_FORMAT_BGR8), SPHC_E_DEVICE);
  storage_.fails_at = UINT32_MAX;
  begin();
  EXPECT_EQ(sphc_raw_writer_add(&writer_, nullptr, nullptr, nullptr), SPHC_E_ARGUMENT);
  writer_.frame_count = UINT32_MAX;
  EXPECT_EQ(addTiny(0), SPHC_E_STATE);
}

}  // namespace

}  // namespace sphc::contract
