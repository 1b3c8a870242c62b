// From a walk without poses to a pose in its map, as a user does it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "command_runner.h"
#include "host/cli/common/exit_code.h"
#include "tests/unit/host/tiny_map.h"

namespace sphc::host {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// A short walk through a simulated room, made once.
class MapTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TempFolder>();
    const Answer walk = runCommand("simulate --frames 10 --rate 5 --out " + at("walk"));
    ASSERT_EQ(walk.exit_code, kExitDone) << walk.err;
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static std::string at(const std::string &name) { return *folder_ / name; }
  static std::unique_ptr<TempFolder> folder_;
};
std::unique_ptr<TempFolder> MapTest::folder_;

TEST_F(MapTest, AWalkWithoutPosesBecomesAMapThatLocalizes) {
  fs::copy(at("walk"), at("blind"), fs::copy_options::recursive);
  fs::remove(at("blind") + "/groundtruth.txt");
  const Answer mapped =
      runCommand("map -r " + at("blind") + " --model " + at("blind.model") + " --trajectory " + at("blind.tum"));
  ASSERT_EQ(mapped.exit_code, kExitDone) << mapped.err;
  const Answer built = runCommand("build --model " + at("blind.model") + " -m " + at("blind.sphc"));
  ASSERT_EQ(built.exit_code, kExitDone) << built.err;
  const std::string localize = "localize -r " + at("walk") + " -m " + at("blind.sphc") + " --owner-note " +
                               at("blind.sphc.owner.json") + " --mode single --json";
  const Answer found = runCommand(localize + " --align");
  ASSERT_EQ(found.exit_code, kExitDone) << found.err;
  const auto summary = nlohmann::json::parse(found.out);
  EXPECT_GE(summary["aligned_frames"], 8);
  EXPECT_GE(summary["within_5cm_5deg"], 9);
  EXPECT_EQ(summary["wrong_accepted"], 0);
  // The map's world is its first camera, not the recording's.
  EXPECT_EQ(nlohmann::json::parse(runCommand(localize).out)["within_5cm_5deg"], 0);
}

TEST_F(MapTest, TheScoreComparesWithThePosesOfTheRecording) {
  const Answer mapped = runCommand("map -r " + at("walk") + " --model " + at("walk.model") + " --score --json");
  ASSERT_EQ(mapped.exit_code, kExitDone) << mapped.err;
  const auto summary = nlohmann::json::parse(mapped.out);
  EXPECT_EQ(summary["frames_mapped"], 10);
  EXPECT_EQ(summary["parts"], 1);
  EXPECT_LT(summary["score"]["rigid_rmse_m"], 0.01);
  EXPECT_NEAR(summary["score"]["scale"], 1, 0.02);
  EXPECT_LT(summary["score"]["rotation_worst_deg"], 5);  // aligned by places on a path of a step
}

// Adds the images of another walk, 100 s later.
void append(const std::string &walk, const std::string &other) {
  for (const std::string kind : {"rgb", "depth"}) {
    std::ifstream from(other + "/" + kind + ".txt");
    std::ofstream to(walk + "/" + kind + ".txt", std::ios::app);
    for (std::string line; std::getline(from, line);) {
      if (line[0] == '#') continue;
      const size_t space = line.find(' ');
      const std::string name = kind + "/other_" + fs::path(line.substr(space + 1)).filename().string();
      fs::copy(other + "/" + line.substr(space + 1), walk + "/" + name);
      to << std::to_string(std::stod(line) + 100) << " " << name << "\n";
    }
  }
}

TEST_F(MapTest, PartsThatNeverMetAreNamedAndTheStatusSaysSo) {
  const Answer other = runCommand("simulate --frames 6 --rate 5 --seed 9 --out " + at("other"));
  ASSERT_EQ(other.exit_code, kExitDone) << other.err;
  fs::copy(at("walk"), at("both"), fs::copy_options::recursive);
  append(at("both"), at("other"));
  const Answer mapped = runCommand("map -r " + at("both") + " --model " + at("both.model") + " --json");
  EXPECT_EQ(mapped.exit_code, kExitWalkApart) << mapped.err;
  EXPECT_THAT(mapped.err, HasSubstr("10 of 16 frames: 0.0 to 1.8 s"));
  EXPECT_THAT(mapped.err, HasSubstr("never met 100.0 to 101.0 s (6 frames)"));
  const auto summary = nlohmann::json::parse(mapped.out);
  EXPECT_EQ(summary["parts"], 2);
  EXPECT_EQ(summary["frames_mapped"], 10);
}

TEST_F(MapTest, WhatCannotBeMappedIsRefusedWithItsCure) {
  const Answer alone = runCommand("map -r " + at("walk") + " --last 0 --model " + at("one.model"));
  EXPECT_EQ(alone.exit_code, kExitFailure);
  EXPECT_THAT(alone.err, HasSubstr("no two frames of the walk agree"));
  EXPECT_FALSE(fs::exists(at("one.model")));
  const Answer missing = runCommand("map -r " + at("nowhere") + " --model " + at("x.model"));
  EXPECT_THAT(missing.err, HasSubstr("cannot open the recording"));
}

TEST_F(MapTest, NothingOfOthersIsReplaced) {
  std::ofstream(at("notes")) << "mine";
  const Answer answer = runCommand("map -r " + at("walk") + " --model " + at("notes"));
  EXPECT_EQ(answer.exit_code, kExitFailure);
  EXPECT_THAT(answer.err, HasSubstr("--force"));
  EXPECT_EQ(runCommand("map -r " + at("walk") + " --model " + at("walk/rgb.txt")).exit_code, kExitUsage);
}

}  // namespace
}  // namespace sphc::host
