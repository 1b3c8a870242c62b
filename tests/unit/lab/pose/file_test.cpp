#include "lab/pose/file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "pose_bytes.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

using test::goodPoseFile;
using test::PoseBytes;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::string refusal(const PoseBytes &bytes) {
  return sphc::test::refusal([&] { parsePoseFile(bytes.span(), "FILE"); });
}

TEST(PoseFile, ReadsEveryField) {
  const PoseFile file = parsePoseFile(goodPoseFile().span(), "FILE");
  EXPECT_EQ(file.eta_percent, 33u);
  EXPECT_EQ(file.depth_rule, 7u);
  EXPECT_EQ(file.centre_world_m, Vector3(1, 2, 3));
  ASSERT_EQ(file.queries.size(), 2u);
  const PoseQuery &query = file.queries[0];
  EXPECT_EQ(query.name, "ab");
  EXPECT_EQ(query.index, 7u);
  EXPECT_EQ(query.camera.fx_px, 500);
  EXPECT_EQ(query.camera.cy_px, 240);
  EXPECT_EQ(query.camera.width_px, 640u);
  EXPECT_EQ(query.camera_from_map.rotation, Matrix3::Identity());
  EXPECT_EQ(query.camera_from_map.translation_m, Vector3(0.1, -0.2, 2));
  ASSERT_EQ(query.rows.size(), 3u);
  EXPECT_EQ(query.rows[1].pixel_px, Vector2(370, 240));
  EXPECT_EQ(query.rows[1].direction, Vector3(0.6, 0, 0.8));
  EXPECT_EQ(query.rows[1].z_tof_m, 0);
  EXPECT_EQ(query.rows[1].z_oracle_m, 2.1);
  EXPECT_TRUE(query.rows[1].is_true);
  EXPECT_EQ(query.rows[2].point_id, 2u);
  EXPECT_TRUE(file.queries[1].rows.empty());
}

TEST(PoseFile, EveryTruncationIsRefused) {
  const PoseBytes good = goodPoseFile();
  for (size_t size = 0; size < good.bytes.size(); ++size) {
    // Memory of exactly this size, so that a sanitizer sees a step too far.
    const std::vector<uint8_t> part(good.bytes.begin(), good.bytes.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_THROW(parsePoseFile({part.data(), part.size()}, "FILE"), std::runtime_error) << size;
  }
}

TEST(PoseFile, MessageHasNamePlaceCauseAndCure) {
  PoseBytes bytes = goodPoseFile();
  bytes.bytes[0] = 'X';
  EXPECT_EQ(refusal(bytes),
            "FILE, byte 4: it does not begin with SPHC; is it a whole correspondence file? Copy or make it again");
}

TEST(PoseFile, BytesThatCannotBeAreRefused) {
  using namespace test;
  const struct {
    const char *cause;
    PoseBytes bytes;
  } faults[] = {
      {"version", goodPoseFile().put<uint32_t>(kAtVersion, 2)},
      {"more queries", goodPoseFile().put<uint32_t>(kAtQueries, 0xFFFFFFFF)},
      {"more queries", goodPoseFile().put<uint32_t>(kAtQueries, 4)},
      {"the file ends", goodPoseFile().put<uint32_t>(kAtQueries, 3)},
      {"bytes after", goodPoseFile().put<uint32_t>(kAtQueries, 1)},
      {"eta", goodPoseFile().put<uint32_t>(kAtEta, 0)},
      {"eta", goodPoseFile().put<uint32_t>(kAtEta, 101)},
      {"reserved", goodPoseFile().put<uint32_t>(kAtReserved, 1)},
      {"the centre", goodPoseFile().put(kAtCentre, kNan)},
      {"name", goodPoseFile().put<uint32_t>(kAtNameLength, 0xFFFFFFF0)},
      {"do not print", goodPoseFile().put<char>(kAtName, '\x1b')},
      {"focal", goodPoseFile().put(kAtFocal, 0.0)},
      {"focal", goodPoseFile().put(kAtFocal, kNan)},
      {"distort", goodPoseFile().put<uint32_t>(kAtDistortion, 4)},
      {"image size", goodPoseFile().put<uint32_t>(kAtWidth, 0)},
      {"rotation", goodPoseFile().put(kAtRotation, 1.01)},
      {"rotation", goodPoseFile().put(kAtRotation, -1.0)},
      {"rotation", goodPoseFile().put(kAtRotation, 1e300)},
      {"more rows", goodPoseFile().put<uint32_t>(kAtRowCount, 0x04000000)},
      {"a pixel", goodPoseFile().put(kAtRow, std::numeric_limits<double>::infinity())},
      {"unit length", goodPoseFile().put(kAtRow + 16, 0.7)},
      {"a direction", goodPoseFile().put(kAtRow + 16, kNan)},
      {"a depth", goodPoseFile().put(kAtRow + 40, kNan)},
      {"negative", goodPoseFile().put(kAtRow + 40, -1.0)},
      {"is_true", goodPoseFile().put<uint32_t>(kAtRow + 56, 2)},
      {"bytes after", goodPoseFile().add<uint8_t>(0)},
  };
  for (const auto &fault : faults) EXPECT_THAT(refusal(fault.bytes), HasSubstr(fault.cause));
}

TEST(PoseFile, CompanionsAreNamedByTheStem) {
  EXPECT_EQ(eta100Path("a_b/room_eta33_dev.bin"), "a_b/room_eta100_dev.bin");
  EXPECT_EQ(eta100Path("room_eta5.bin"), "room_eta100.bin");
  EXPECT_EQ(eta100Path("x_eta33_/room.bin"), "");
  EXPECT_EQ(eta100Path("room_eta_dev.bin"), "");
  EXPECT_EQ(pointsPath("d/room_eta100_dev.bin"), "d/room_eta100_dev_xyz.bin");
}

TEST(PoseFile, PointsAreInTheOrderOfRows) {
  PoseFile file = parsePoseFile(goodPoseFile().span(), "FILE");
  PoseBytes points;
  for (int i = 0; i < 9; ++i) points.add(static_cast<double>(i));
  parsePosePoints(points.span(), "POINTS", &file);
  ASSERT_EQ(file.queries[0].points_map_m.size(), 3u);
  EXPECT_EQ(file.queries[0].points_map_m[2], Vector3(6, 7, 8));
  EXPECT_TRUE(file.queries[1].points_map_m.empty());
}

TEST(PoseFile, PointsThatDoNotFitAreRefused) {
  PoseFile file = parsePoseFile(goodPoseFile().span(), "FILE");
  PoseBytes points;
  for (int i = 0; i < 9; ++i) {
    EXPECT_THROW(parsePosePoints(points.span(), "POINTS", &file), std::runtime_error) << i;
    points.add(1.0);
  }
  EXPECT_THROW(parsePosePoints(PoseBytes(points).add<uint8_t>(0).span(), "POINTS", &file), std::runtime_error);
  EXPECT_THROW(parsePosePoints(points.put(8, kNan).span(), "POINTS", &file), std::runtime_error);
}

TEST(PoseFile, TruePointsAreFoundBesideTheFile) {
  const sphc::test::TempFolder folder;
  const auto write = [&folder](const char *name, const PoseBytes &bytes) {
    folder.write(name, {bytes.bytes.begin(), bytes.bytes.end()});
  };
  const std::string path = folder / "r_eta33_odd.bin";
  EXPECT_TRUE(readTruePoints(path).queries.empty());
  write("r_eta100_odd.bin", goodPoseFile().put<uint32_t>(test::kAtEta, 100));
  EXPECT_TRUE(readTruePoints(path).queries.empty());
  PoseBytes points;
  for (int i = 0; i < 9; ++i) points.add(1.0 + i);
  write("r_eta100_odd_xyz.bin", points);
  EXPECT_EQ(readTruePoints(path).queries.at(0).points_map_m.at(0), Vector3(1, 2, 3));
  write("r_eta100_odd_xyz.bin", PoseBytes());
  EXPECT_THROW(readTruePoints(path), std::runtime_error);
}

TEST(PoseFile, AMissingFileIsToldByName) {
  EXPECT_THAT(sphc::test::refusal([] { readPoseFile("/nowhere/x.bin"); }), HasSubstr("/nowhere/x.bin"));
}

}  // namespace
}  // namespace sphc::host
