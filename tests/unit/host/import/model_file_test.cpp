#include "host/import/model_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include "runtime/map/crc32.h"
#include "tests/support/made_up_model.h"
#include "tests/support/refusal.h"
#include "tests/support/release_request.h"
#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

using testing::HasSubstr;

constexpr size_t kHeaderBytes = 32, kPointBytes = 164, kCrcAt = 28, kSigmaAt = 24, kObservationsAt = 32;

class ModelFile : public testing::Test {
 protected:
  const test::TempFolder folder_;
  const std::string path_ = folder_ / "room.model";
};

void expectSame(const PointModel &a, const PointModel &b) {
  EXPECT_EQ(a.band, b.band);
  ASSERT_EQ(a.points.size(), b.points.size());
  for (size_t i = 0; i < a.points.size(); ++i) {
    EXPECT_EQ(a.points[i].position_m, b.points[i].position_m);
    EXPECT_EQ(a.points[i].sigma_m, b.points[i].sigma_m);
    EXPECT_EQ(a.points[i].observations, b.points[i].observations);
    EXPECT_EQ(std::memcmp(&a.points[i].descriptor, &b.points[i].descriptor, sizeof(Descriptor)), 0);
  }
}

mode_t modeOf(const std::string &path) {
  struct stat facts = {};
  EXPECT_EQ(stat(path.c_str(), &facts), 0);
  return facts.st_mode & 0777;
}

// With the checksum of what it holds now, so that checks behind it are reached.
std::vector<uint8_t> sealed(std::vector<uint8_t> bytes) {
  std::memset(&bytes[kCrcAt], 0, 4);
  const uint32_t crc = crc32(0, bytes.data(), bytes.size());
  std::memcpy(&bytes[kCrcAt], &crc, 4);
  return bytes;
}

std::string whyRefused(const std::vector<uint8_t> &bytes) {
  return test::refusal([&] { decodeModel(bytes); });
}

TEST_F(ModelFile, GivesBackWhatItWasGiven) {
  PointModel room = test::madeUpRoom(300, 1);
  room.points[7].position_m.x() = 1.0 / 3;
  room.points[8].sigma_m = 0;
  room.points[9].observations = std::numeric_limits<uint32_t>::max();
  writeModelFile(path_, room);
  expectSame(readModelFile(path_), room);
  EXPECT_EQ(std::filesystem::file_size(path_), kHeaderBytes + 300 * kPointBytes);
  expectSame(decodeModel(encodeModel({})), {});
  room.band = SPHC_BAND_INFRARED;
  expectSame(decodeModel(encodeModel(room)), room);
}

TEST_F(ModelFile, GivesTheSameMap) {
  const PointModel room = test::madeUpRoom(300, 1);
  writeModelFile(path_, room);
  EXPECT_EQ(makeRelease(readModelFile(path_), test::releaseRequest()).file,
            makeRelease(room, test::releaseRequest()).file);
}

TEST_F(ModelFile, IsTheOwnersAlone) {
  const mode_t before = umask(0);
  writeModelFile(path_, test::madeUpRoom(10, 1));
  umask(before);
  EXPECT_EQ(modeOf(path_), 0600u);
  chmod(path_.c_str(), 0640);
  EXPECT_THAT(test::refusal([&] { readModelFile(path_); }), HasSubstr("chmod 600 " + path_));
}

// What else may be replaced is for the command to say.
TEST_F(ModelFile, ReplacesAPointModel) {
  writeModelFile(path_, test::madeUpRoom(10, 1));
  writeModelFile(path_, test::madeUpRoom(20, 2));
  expectSame(readModelFile(path_), test::madeUpRoom(20, 2));
  const std::string other = folder_ / "notes.txt";
  std::ofstream(other) << "what matters";
  EXPECT_FALSE(isModelFile(other));
  EXPECT_THAT(test::refusal([&] { writeModelFile(folder_.path(), {}); }), HasSubstr("cannot write"));
  EXPECT_THAT(test::refusal([&] { writeModelFile(folder_ / "none/x", {}); }), HasSubstr("cannot write"));
}

TEST_F(ModelFile, WhatIsNoFileIsRefusedAtOnce) {
  EXPECT_THAT(test::refusal([&] { readModelFile(path_); }), HasSubstr("is the file there?"));
  EXPECT_THAT(test::refusal([&] { readModelFile(folder_.path()); }), HasSubstr("it is no file"));
  ASSERT_EQ(mkfifo(path_.c_str(), 0600), 0);
  EXPECT_THAT(test::refusal([&] { readModelFile(path_); }), HasSubstr("it is no file"));
}

TEST(ModelBytes, EveryByteIsChecked) {
  const std::vector<uint8_t> good = encodeModel(test::madeUpRoom(3, 1));
  for (size_t i = 0; i < good.size(); ++i) {
    std::vector<uint8_t> bytes = good;
    bytes[i] ^= 0x10;
    EXPECT_NE(whyRefused(bytes), "") << i;
  }
  for (size_t size = 0; size < good.size(); ++size)
    EXPECT_NE(whyRefused({good.begin(), good.begin() + static_cast<ptrdiff_t>(size)}), "") << size;
  std::vector<uint8_t> longer = good;
  longer.push_back(0);
  EXPECT_THAT(whyRefused(longer), HasSubstr("too many bytes"));
}

TEST(ModelBytes, WhatCouldNotBeReadIsNotWritten) {
  for (double bad : {std::nan(""), HUGE_VAL, 1e6}) {
    PointModel far = test::madeUpRoom(3, 1), unknown = far;
    far.points[1].position_m.z() = unknown.points[1].sigma_m = bad;
    for (const PointModel &model : {far, unknown})
      EXPECT_THAT(test::refusal([&] { encodeModel(model); }), HasSubstr("nobody knows where"));
  }
}

TEST(ModelBytes, AnUnknownBandIsRefused) {
  std::vector<uint8_t> bytes = encodeModel(test::madeUpRoom(3, 1));
  EXPECT_EQ(bytes[10], 0);  // as before there were bands
  bytes[10] = 2;
  EXPECT_THAT(whyRefused(sealed(bytes)), HasSubstr("band"));
}

TEST(ModelBytes, ASealedLieIsRefusedToo) {
  const std::vector<uint8_t> good = encodeModel(test::madeUpRoom(3, 1));
  const auto with = [&](size_t at, auto value) {
    std::vector<uint8_t> bytes = good;
    std::memcpy(&bytes[at], &value, sizeof value);
    return whyRefused(sealed(bytes));
  };
  EXPECT_EQ(whyRefused(sealed(good)), "");
  const size_t second = kHeaderBytes + kPointBytes;
  for (double bad : {std::nan(""), HUGE_VAL, 1e7}) EXPECT_THAT(with(second, bad), HasSubstr("out of range"));
  for (double bad : {std::nan(""), -0.1, 1e7}) EXPECT_THAT(with(second + kSigmaAt, bad), HasSubstr("out of range"));
  EXPECT_THAT(with(second + kObservationsAt, uint32_t{0}), HasSubstr("out of range"));
  EXPECT_THAT(with(8, uint32_t{2}), HasSubstr("another version"));
  EXPECT_THAT(with(12, uint32_t{99}), HasSubstr("map the recording again"));
  EXPECT_THAT(with(24, uint32_t{4}), HasSubstr("cut"));
  EXPECT_THAT(with(24, std::numeric_limits<uint32_t>::max()), HasSubstr("cut"));
}

}  // namespace
}  // namespace sphc::host
