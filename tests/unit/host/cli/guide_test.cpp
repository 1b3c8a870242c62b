// Guidance while a walk is recorded, and afterwards, as a user asks for it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "command_runner.h"
#include "host/cli/common/exit_code.h"
#include "host/recording/recording_writer.h"
#include "tests/support/temp_folder.h"
#include "tests/unit/host/guide/made_up_wall.h"

namespace sphc::host {
namespace {

using testing::HasSubstr;

constexpr uint32_t kFramesOfWall = 12;

// A second along a wall; the last frames are dark.
void writeWall(const std::string &folder, int64_t depth_lag_ns = 0) {
  MadeUpWall wall(1);
  const sphc_rig rig = wallRig();
  sphc_recording_writer *writer = nullptr;
  ASSERT_EQ(sphc_recording_create(folder.c_str(), &rig, &writer, nullptr), SPHC_OK);
  for (uint32_t i = 0; i < kFramesOfWall; ++i) {
    const bool is_dark = i + 4 > kFramesOfWall;
    sphc_localizer_frame frame =
        wall.view(20 * static_cast<int>(i), 100000000 * int64_t{i + 1}, is_dark ? 0.04 : 1);
    frame.depth_time_ns += depth_lag_ns;
    ASSERT_EQ(sphc_recording_add_frame(writer, &frame, nullptr), SPHC_OK);
  }
  ASSERT_EQ(sphc_recording_close(&writer, nullptr), SPHC_OK);
}

class GuideTest : public testing::Test {
 protected:
  void SetUp() override { writeWall(at("wall")); }
  std::string at(const std::string &name) const { return folder_ / name; }
  test::TempFolder folder_;
};

TEST_F(GuideTest, WhatCannotBeReadOrComparedIsRefused) {
  for (const auto &image : std::filesystem::directory_iterator(at("wall") + "/depth"))
    std::filesystem::remove(image.path());
  EXPECT_EQ(runCommand("guide --score --recording " + at("wall")).exit_code, kExitUsage);
  const Answer answer = runCommand("guide --recording " + at("wall"));
  EXPECT_EQ(answer.exit_code, kExitFailure);
  EXPECT_THAT(answer.err, HasSubstr("not one frame can be read; the first: depth/000000.png"));
  const Answer doctor = runCommand("doctor --device replay:" + at("wall"));
  EXPECT_EQ(doctor.exit_code, kExitFailure);
  EXPECT_THAT(doctor.out, HasSubstr("depth/000009.png"));
  EXPECT_THAT(doctor.out, testing::Not(HasSubstr("depth/000010.png")));
  EXPECT_THAT(doctor.out, HasSubstr("2 more captures had such troubles"));
}

TEST_F(GuideTest, ARecordingIsGuidedAndLosesNothing) {
  const Answer answer =
      runCommand("record --guide --json --device replay:" + at("wall") + " --out " + at("walk.mcap"));
  ASSERT_EQ(answer.exit_code, kExitDone) << answer.err;
  const std::vector<nlohmann::json> lines = jsonLines(answer.out);
  ASSERT_EQ(lines.size(), kFramesOfWall + 1);
  EXPECT_EQ(lines[3]["advice"], "");
  EXPECT_THAT(lines[kFramesOfWall - 1]["advice"].get<std::string>(), HasSubstr("too dark"));
  const nlohmann::json &result = lines.back();
  EXPECT_EQ(result["color"], kFramesOfWall);
  EXPECT_EQ(result["pairs"], kFramesOfWall);
  EXPECT_EQ(result["dropped"], 0);
  EXPECT_EQ(result["guide"]["frames"], kFramesOfWall);
  EXPECT_EQ(result["guide"]["skipped"], 0);
}

TEST_F(GuideTest, ARecordingWithoutDepthSaysWhatIsMissing) {
  for (const auto &image : std::filesystem::directory_iterator(at("wall") + "/depth"))
    std::filesystem::resize_file(image.path(), 0);
  const Answer answer = runCommand("record --device replay:" + at("wall") + " --out " + at("half.mcap"));
  EXPECT_EQ(answer.exit_code, kExitFailure);
  EXPECT_THAT(answer.err, HasSubstr("Not one depth image came"));
  EXPECT_THAT(answer.err, HasSubstr("spherecloud doctor"));
  // A broken camera does not fill the terminal.
  EXPECT_THAT(answer.err, HasSubstr("depth/000009.png"));
  EXPECT_THAT(answer.err, testing::Not(HasSubstr("depth/000010.png")));
  EXPECT_THAT(answer.err, HasSubstr("2 more captures had such troubles"));
}

TEST_F(GuideTest, ARecordingWithoutPairsIsNoSuccess) {
  writeWall(at("late"), 50000000);  // half a frame
  const Answer answer =
      runCommand("record --guide --json --device replay:" + at("late") + " --out " + at("late.mcap"));
  EXPECT_EQ(answer.exit_code, kExitFailure);
  EXPECT_THAT(answer.err, HasSubstr("Not one colour image met a depth image within 20 ms (--tolerance-ms)"));
  const nlohmann::json result = nlohmann::json::parse(answer.out);
  EXPECT_EQ(result["color"], kFramesOfWall);
  EXPECT_EQ(result["depth"], kFramesOfWall);
  EXPECT_EQ(result["pairs"], 0);
  EXPECT_TRUE(std::filesystem::exists(at("late.mcap")));
}

TEST_F(GuideTest, PeopleGetATableAtTheEnd) {
  const Answer answer = runCommand("record --guide --device replay:" + at("wall") + " --out " + at("walk.mcap"));
  ASSERT_EQ(answer.exit_code, kExitDone) << answer.err;
  EXPECT_THAT(answer.out, HasSubstr("frames followed"));
  EXPECT_THAT(answer.out, HasSubstr("hard to map"));
  EXPECT_THAT(answer.out, HasSubstr("closed no loop"));
}

// What is said afterwards is what was said on the way.
TEST_F(GuideTest, ARecordingIsLookedAtAfterwards) {
  const Answer recorded =
      runCommand("record --guide --json --device replay:" + at("wall") + " --out " + at("walk.mcap"));
  const Answer answer = runCommand("guide --json --score --recording " + at("wall"));
  ASSERT_EQ(answer.exit_code, kExitDone) << answer.err;
  const std::vector<nlohmann::json> then = jsonLines(recorded.out), now = jsonLines(answer.out);
  ASSERT_EQ(now.size(), then.size());
  for (size_t i = 0; i + 1 < now.size(); ++i) EXPECT_EQ(now[i]["advice"], then[i]["advice"]) << i;
  EXPECT_EQ(now.back()["summary"]["path_m"], then.back()["guide"]["path_m"]);
}

}  // namespace
}  // namespace sphc::host
