#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "spherecloud/spherecloud.hpp"
#include "tests/capi/bytes.h"
#include "tests/support/map_bytes.h"
#include "tests/support/session.h"

namespace {

using sphc::test::expectMentions;
using sphc::test::GuardedMemory;
using sphc::test::Output;

class CInterfaceMap : public testing::Test {
 protected:
  void SetUp() override {
    sphc_memory need = {};
    ASSERT_EQ(sphc_map_memory(&need), SPHC_OK);
    EXPECT_EQ(need.scratch_bytes, 0u);
    bytes_ = need.state_bytes;
    memory_ = GuardedMemory(bytes_, need.alignment);
  }
  sphc_status init(const std::vector<uint8_t> &file) {
    return sphc_map_init(memory_.data(), bytes_, file.data(), file.size(), &map_, &message_);
  }
  void expectRefused(sphc_status expected, sphc_status actual, const char *words) {
    EXPECT_EQ(expected, actual);
    expectMentions(message_.text, words);
    EXPECT_EQ(map_, nullptr);
  }

  size_t bytes_ = 0;
  GuardedMemory memory_;
  sphc_map *map_ = nullptr;
  sphc_message message_ = {};
  std::vector<uint8_t> file_ = sphc::test::randomMap(50, 1);
};

TEST(ReadFile, NamesAFolder) {
  spherecloud::AlignedBuffer bytes;
  const spherecloud::Status status = spherecloud::readFile(testing::TempDir().c_str(), &bytes);
  EXPECT_EQ(status.code(), SPHC_E_DEVICE);
  expectMentions(status.text(), "folder");
}

TEST_F(CInterfaceMap, OpensAndTellsWhatIsInIt) {
  ASSERT_EQ(init(file_), SPHC_OK);
  sphc_map_info info = {};
  info.struct_size = sizeof info;
  ASSERT_EQ(sphc_map_get_info(map_, &info), SPHC_OK);
  EXPECT_EQ(info.struct_size, sizeof info);
  EXPECT_EQ(info.point_count, 50u);
  EXPECT_EQ(info.file_bytes, file_.size());
  EXPECT_EQ(info.format_version, 2u);
  EXPECT_EQ(info.map_id[15], 0xAF);
  EXPECT_EQ(info.band, SPHC_BAND_VISIBLE);
  double direction[3];
  ASSERT_EQ(sphc_map_direction(map_, 49, direction), SPHC_OK);
  EXPECT_NEAR(direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2], 1, 1e-6);
  EXPECT_TRUE(memory_.guardsIntact());
  sphc_map_fini(&map_);
  EXPECT_EQ(map_, nullptr);
}

TEST_F(CInterfaceMap, TellsItsBandToWhoKnowsBands) {
  sphc::test::setBand(&file_, SPHC_BAND_INFRARED);
  ASSERT_EQ(init(file_), SPHC_OK);
  sphc_map_info info = {};
  info.struct_size = sizeof info;
  ASSERT_EQ(sphc_map_get_info(map_, &info), SPHC_OK);
  EXPECT_EQ(info.band, SPHC_BAND_INFRARED);
  info = {};
  info.struct_size = offsetof(sphc_map_info, band);  // of a program that was built before
  ASSERT_EQ(sphc_map_get_info(map_, &info), SPHC_OK);
  EXPECT_EQ(info.point_count, 50u);
  EXPECT_EQ(info.band, SPHC_BAND_VISIBLE);  // untouched
}

TEST_F(CInterfaceMap, NullArguments) {
  EXPECT_EQ(sphc_map_memory(nullptr), SPHC_E_ARGUMENT);
  expectRefused(SPHC_E_ARGUMENT, sphc_map_init(nullptr, bytes_, file_.data(), file_.size(), &map_, &message_),
                "null");
  expectRefused(SPHC_E_ARGUMENT, sphc_map_init(memory_.data(), bytes_, nullptr, 100, &map_, &message_),
                "file is null");
  EXPECT_EQ(sphc_map_init(memory_.data(), bytes_, file_.data(), file_.size(), nullptr, &message_), SPHC_E_ARGUMENT);
  expectMentions(message_.text, "map is null");
  EXPECT_EQ(sphc_map_init(memory_.data(), bytes_, file_.data(), 10, &map_, nullptr), SPHC_E_MAP_FORMAT);
}

TEST_F(CInterfaceMap, MemoryTooSmallOrMisaligned) {
  expectRefused(SPHC_E_MEMORY_SIZE,
                sphc_map_init(memory_.data(), bytes_ - 1, file_.data(), file_.size(), &map_, &message_),
                "are needed");
  expectRefused(SPHC_E_MEMORY_SIZE, sphc_map_init(memory_.data(), 0, file_.data(), file_.size(), &map_, &message_),
                "has 0 bytes");
  GuardedMemory larger(bytes_ + 64, 64);
  void *odd = static_cast<uint8_t *>(larger.data()) + 1;
  expectRefused(SPHC_E_MEMORY_ALIGNMENT, sphc_map_init(odd, bytes_, file_.data(), file_.size(), &map_, &message_),
                "aligned");
  std::vector<uint8_t> shifted(file_.size() + 8);
  std::memcpy(shifted.data() + 4, file_.data(), file_.size());
  expectRefused(SPHC_E_MEMORY_ALIGNMENT,
                sphc_map_init(memory_.data(), bytes_, shifted.data() + 4, file_.size(), &map_, &message_),
                "aligned to 8");
}

TEST_F(CInterfaceMap, MemoryInsideTheFile) {
  const std::vector<uint8_t> before = file_;
  void *inside = file_.data() + 64;
  expectRefused(SPHC_E_ARGUMENT, sphc_map_init(inside, bytes_, file_.data(), file_.size(), &map_, &message_),
                "map memory overlaps the map file's bytes");
  EXPECT_EQ(file_, before);
}

TEST_F(CInterfaceMap, EmptyFile) {
  expectRefused(SPHC_E_MAP_FORMAT, init(std::vector<uint8_t>(1, 0x89)), "shorter");
}

TEST_F(CInterfaceMap, FailureLeavesMemoryUntouched) {
  const std::vector<uint8_t> before = memory_.copy();
  file_.back() ^= 1;
  expectRefused(SPHC_E_MAP_CHECKSUM, init(file_), "changed");
  EXPECT_EQ(memory_.copy(), before);
  EXPECT_TRUE(memory_.guardsIntact());
}

TEST_F(CInterfaceMap, InfoAndDirectionRefuse) {
  ASSERT_EQ(init(file_), SPHC_OK);
  Output<sphc_map_info> info;
  EXPECT_EQ(sphc_map_get_info(nullptr, info.get()), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_map_get_info(map_, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_map_get_info(map_, info.get()), SPHC_E_STRUCT_SIZE);
  EXPECT_TRUE(info.untouched());
  Output<double[3]> direction;
  EXPECT_EQ(sphc_map_direction(map_, 50, *direction.get()), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_map_direction(map_, UINT32_MAX, *direction.get()), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_map_direction(nullptr, 0, *direction.get()), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_map_direction(map_, 0, nullptr), SPHC_E_ARGUMENT);
  EXPECT_TRUE(direction.untouched());
}

TEST_F(CInterfaceMap, FiniTakesNothing) {
  sphc_map_fini(nullptr);
  sphc_map_fini(&map_);
  EXPECT_EQ(map_, nullptr);
}

}  // namespace
