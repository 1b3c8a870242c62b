// Arguments, exit codes and results of spherecloud-lab, seen from outside.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "host/cli/common/exit_code.h"
#include "tests/support/temp_folder.h"
#include "tests/unit/host/cli/command_runner.h"

namespace sphc::host {
namespace {

using testing::HasSubstr;

Answer runLab(const std::string &arguments) { return runProgram(SPHC_LAB_COMMAND, arguments); }

class LabHelpTest : public testing::TestWithParam<const char *> {};

TEST_P(LabHelpTest, TeachesByExample) {
  const Answer answer = runLab(std::string(GetParam()) + " --help");
  EXPECT_EQ(answer.exit_code, kExitDone);
  EXPECT_THAT(answer.out, HasSubstr("Example:\n  spherecloud-lab " + std::string(GetParam())));
  EXPECT_THAT(answer.out, HasSubstr("--json"));
  EXPECT_EQ(answer.err, "");
}

INSTANTIATE_TEST_SUITE_P(EachSubcommand, LabHelpTest,
                         testing::Values("align", "compare", "features", "frame", "map", "match", "pose", "predict",
                                         "recording", "releases", "rig"));

class LabUsageTest : public testing::TestWithParam<const char *> {};

TEST_P(LabUsageTest, IsExitCodeTwoAndPointsToHelp) {
  const Answer answer = runLab(GetParam());
  EXPECT_EQ(answer.exit_code, kExitUsage);
  EXPECT_EQ(answer.out, "");
  EXPECT_THAT(answer.err, HasSubstr("spherecloud-lab"));
  EXPECT_THAT(answer.err, HasSubstr("--help"));
}

INSTANTIATE_TEST_SUITE_P(EachMistake, LabUsageTest,
                         testing::Values("", "conquer", "compare", "compare --recording r --correspondences f",
                                         "compare --correspondences f --out o",
                                         "compare --correspondences f --query-step 5",
                                         "compare --correspondences f --eta 0.5",
                                         "compare --correspondences f --attack --results l", "pose",
                                         "pose f --depth radar", "pose f --repeat 0", "frame --recording r",
                                         "map --recording r --out o", "map --recording r --out o --points 0"));

// As in names of files; CLI11 takes them for octal.
TEST(Lab, NumbersOfFramesMayHaveZerosInFront) {
  for (const std::string command : {"match --query-first 009 --query-last 009 --query-step 01",
                                    "compare --query-first 009 --query-last 009 --query-step 01",
                                    "frame --map m --mapping-first 009 --mapping-last 009 --mapping-step 01",
                                    "features --first 009 --last 009 --step 01",
                                    "releases --more-last 009 --other-first 009 --other-last 009 --strangers s"}) {
    const Answer answer = runLab(command + " --recording /nonexistent");
    EXPECT_EQ(answer.exit_code, kExitFailure) << command;
    EXPECT_THAT(answer.err, HasSubstr("/nonexistent")) << command;
  }
}

// Maps of wanted sizes, and the library's own variants on them.
TEST(Lab, MakesMapsOfWantedSizesAndTimesFramesOnThem) {
  const test::TempFolder folder;
  const std::string walk = folder / "walk";
  ASSERT_EQ(runCommand("simulate --frames 6 --rate 6 --out " + walk).exit_code, kExitDone);
  const Answer made =
      runLab("map -r " + walk + " --step 2 --points 500 --points 9000 --out " + (folder / "maps") + " --json");
  ASSERT_EQ(made.exit_code, kExitDone) << made.err;
  EXPECT_EQ(nlohmann::json::parse(made.out)["maps"][0]["own_points"], 500);
  EXPECT_LT(nlohmann::json::parse(made.out)["maps"][1]["own_points"], 9000);
  const std::string frame = "frame -r " + walk + "/ --first 1 --step 2 --repeat 1 --no-peers --map ";
  const Answer timed = runLab(frame + (folder / "maps/map_500.sphc") + " --map " + (folder / "maps/map_9000.sphc") +
                              " --results " + (folder / "frame.csv") + " --json");
  ASSERT_EQ(timed.exit_code, kExitDone) << timed.err;
  const auto tables = nlohmann::json::parse(timed.out)["tables"];
  ASSERT_EQ(tables.size(), 2u);
  EXPECT_EQ(tables[1]["points"], 9000);
  EXPECT_EQ(tables[1]["recording"], "walk");
  for (const auto &variant : tables[1]["variants"]) {
    EXPECT_EQ(variant["frames"], 3);
    EXPECT_EQ(variant["within_5cm_5deg_percent"], 100) << variant["variant"];
    EXPECT_GT(variant["state_bytes"], 0);
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "frame.csv"));
  const std::string one = frame + (folder / "maps/map_500.sphc") + " --results ";
  EXPECT_EQ(runLab(one + (folder / "maps/map_500.sphc")).exit_code, kExitUsage) << "an output is an input";
  EXPECT_THAT(runLab(one + (folder / "maps/map_9000.sphc")).err, HasSubstr("--force"));
  EXPECT_EQ(runLab(one + (folder / "frame.csv")).exit_code, kExitDone) << "its own results";
  const Answer none = runLab(frame + (folder / "maps/map_500.sphc") + " --only nobody");
  EXPECT_EQ(none.exit_code, kExitUsage);
  EXPECT_THAT(none.err, HasSubstr("'ours, tracking'"));
}

TEST(Lab, ComparesPredictionsWithTheWalk) {
  const test::TempFolder folder;
  const std::string walk = folder / "walk";
  ASSERT_EQ(runCommand("simulate --frames 8 --rate 30 --out " + walk).exit_code, kExitDone);
  const Answer made = runLab("map -r " + walk + " --step 3 --points 9000 --out " + (folder / "maps") + " --json");
  ASSERT_EQ(made.exit_code, kExitDone) << made.err;
  const Answer answer = runLab("predict -r " + walk + " --map " + (folder / "maps/map_9000.sphc") +
                               " --ahead-ms 0 --ahead-ms 33 --json");
  ASSERT_EQ(answer.exit_code, kExitDone) << answer.err;
  const auto rows = nlohmann::json::parse(answer.out);
  ASSERT_EQ(rows.size(), 4u);
  for (const auto &row : rows) {
    EXPECT_GE(row["predictions"], 5);
    EXPECT_LT(row["error_m"], 0.05);
    EXPECT_LT(row["error_deg"], 1);
    EXPECT_GT(row["shift_sigmas_95"], 0);
  }
  EXPECT_NEAR(rows[0]["error_m"], rows[0]["last_pose_error_m"], 1e-12);  // 0 ms ahead; the same to rounding
  EXPECT_EQ(rows[3]["ahead_ns"], 33000000);
  EXPECT_TRUE(rows[3]["odometry"]);
  EXPECT_GT(rows[1]["last_pose_error_m"], rows[0]["last_pose_error_m"]);
  const std::string elsewhere = folder / "elsewhere";
  ASSERT_EQ(runCommand("simulate --seed 9 --frames 2 --rate 30 --out " + elsewhere).exit_code, kExitDone);
  const Answer none = runLab("predict -r " + elsewhere + " --map " + (folder / "maps/map_9000.sphc") + " --json");
  const auto first = nlohmann::json::parse(none.out)[0];
  EXPECT_EQ(first["predictions"], 0);
  EXPECT_TRUE(first["error_m"].is_null()) << "nothing was measured";
}

// As localize does: a long measurement is not lost by one bad file.
TEST(Lab, LeavesOutBadImagesAndNamesThem) {
  const test::TempFolder folder;
  const std::string walk = folder / "walk";
  ASSERT_EQ(runCommand("simulate --frames 5 --rate 30 --out " + walk).exit_code, kExitDone);
  ASSERT_EQ(runLab("map -r " + walk + " --points 500 --points 600 --out " + (folder / "maps")).exit_code,
            kExitDone);
  std::ofstream(walk + "/rgb/000002.png") << "no image";
  const std::string commands[] = {"predict -r " + walk + " --map " + (folder / "maps/map_500.sphc"),
                                  "frame --no-peers --repeat 1 -r " + walk + " --map " +
                                      (folder / "maps/map_500.sphc") + " --map " + (folder / "maps/map_600.sphc"),
                                  "align --no-peers --repeat 1 -r " + walk,
                                  "features --no-peers --repeat 1 -r " + walk,
                                  "recording --repeat 1 -r " + walk + " --folder " + folder.path().string()};
  for (const std::string &command : commands) {
    const Answer answer = runLab(command + " --json");
    EXPECT_EQ(answer.exit_code, kExitDone) << command << answer.err;
    EXPECT_EQ(answer.err.find("000002.png"), answer.err.rfind("000002.png")) << command;
    EXPECT_THAT(answer.err, HasSubstr("note: ")) << command;
    EXPECT_THAT(answer.err, HasSubstr("000002.png")) << command;
  }
  EXPECT_THAT(runLab(commands[3]).out, HasSubstr("4 frames"));
  for (const auto &image : std::filesystem::directory_iterator(walk + "/rgb"))
    std::filesystem::resize_file(image.path(), 0);
  for (const std::string &command : commands) {
    const Answer none = runLab(command);
    EXPECT_EQ(none.exit_code, kExitFailure) << command;
    const bool is_frame = command.substr(0, 5) == "frame";  // which leaves out frames without a pose too
    EXPECT_THAT(none.err,
                HasSubstr(is_frame ? "nothing was measured" : "not one frame could be read; check the recording"))
        << command;
  }
}

TEST(Lab, RefusesARecordingWithoutPosesWhereTheyTellRightFromWrong) {
  const test::TempFolder folder;
  const std::string walk = folder / "walk", map = folder / "maps/map_500.sphc";
  ASSERT_EQ(runCommand("simulate --frames 2 --rate 6 --out " + walk).exit_code, kExitDone);
  ASSERT_EQ(runLab("map -r " + walk + " --points 500 --out " + (folder / "maps")).exit_code, kExitDone);
  std::filesystem::remove(walk + "/groundtruth.txt");
  for (const std::string command : {"deadline", "worst", "negative", "predict"}) {
    const Answer answer = runLab(command + " -r " + walk + " --map " + map);
    EXPECT_EQ(answer.exit_code, kExitFailure) << command;
    EXPECT_THAT(answer.err, HasSubstr("no frame of " + walk + " has a pose")) << command;
  }
  EXPECT_EQ(runLab("negative --elsewhere -r " + walk + " --map " + map).exit_code, kExitDone);
}

}  // namespace
}  // namespace sphc::host
