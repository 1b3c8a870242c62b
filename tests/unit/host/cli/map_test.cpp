// From a walk without poses to a pose in its map, as a user does it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "command_runner.h"
#include "explained.h"
#include "host/cli/common/exit_code.h"
#include "host/recording/calibration_json.h"
#include "host/recording/recording_reader.h"
#include "host/recording/recording_writer.h"
#include "host/recording/text_field.h"
#include "runtime/geometry/rigid.h"
#include "tests/contract/tiny_recording.h"
#include "tests/support/ros_bag.h"
#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// A short walk through a simulated room, made once.
class MapTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<test::TempFolder>();
    const Answer walk = runCommand("simulate --frames 10 --rate 5 --out " + at("walk"));
    ASSERT_EQ(walk.exit_code, kExitDone) << walk.err;
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static std::string at(const std::string &name) { return *folder_ / name; }
  static std::unique_ptr<test::TempFolder> folder_;
};
std::unique_ptr<test::TempFolder> MapTest::folder_;

TEST_F(MapTest, AWalkWithoutPosesBecomesAMapThatLocalizes) {
  fs::copy(at("walk"), at("blind"), fs::copy_options::recursive);
  fs::remove(at("blind") + "/groundtruth.txt");
  const Answer mapped =
      runCommand("map -r " + at("blind") + " --model " + at("blind.model") + " --trajectory " + at("blind.tum"));
  ASSERT_EQ(mapped.exit_code, kExitDone) << mapped.err;
  EXPECT_THAT(mapped.err, Not(HasSubstr("note:")));  // nothing is wrong with it
  const Answer unscored = runCommand("map -r " + at("blind") + " --model " + at("unscored.model") + " --score");
  EXPECT_EQ(unscored.exit_code, kExitDone) << "a map is a map without a score";
  EXPECT_THAT(unscored.err, HasSubstr("note: no score of "));
  EXPECT_TRUE(fs::exists(at("unscored.model")));
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
  const Answer two = runCommand(localize + " --align --last 1");
  EXPECT_EQ(two.exit_code, kExitDone) << "what was found is worth a table without errors";
  EXPECT_THAT(two.err, HasSubstr("--align: fewer than 3 localized frames have a pose"));
  EXPECT_TRUE(nlohmann::json::parse(two.out)["within_5cm_5deg_percent"].is_null());
  // The map's world is its first camera, not the recording's.
  const Answer elsewhere = runCommand(localize);
  EXPECT_EQ(nlohmann::json::parse(elsewhere.out)["within_5cm_5deg"], 0);
  EXPECT_THAT(elsewhere.err, HasSubstr("poses are sure and far from the recording's"));
  EXPECT_THAT(found.err, Not(HasSubstr("far from")));
}

TEST_F(MapTest, OfSeveralMapsEachIsAlignedByItself) {
  const std::string walk = at("far");
  ASSERT_EQ(runCommand("simulate --frames 6 --rate 0.5 --out " + walk).exit_code, kExitDone);
  std::string localize = "localize --json --mode single --align -r " + walk + " --trajectory " + at("far.tum");
  for (const std::string frames : {"--first 0 --last 1", "--first 4 --last 5"}) {
    const std::string map = at("far" + frames.substr(8, 1) + ".sphc");
    const Answer built =
        runCommand("build -r " + walk + " " + frames + " -m " + map + " --ledger " + map + ".ledger");
    ASSERT_EQ(built.exit_code, kExitDone) << built.err;
    localize += " -m " + map + " --owner-note " + map + ".owner.json";
  }
  const Answer found = runCommand(localize);
  ASSERT_EQ(found.exit_code, kExitDone) << found.err;
  const auto summary = nlohmann::json::parse(found.out);
  EXPECT_EQ(summary["aligned_frames"], 3);  // the other map has two
  EXPECT_EQ(summary["within_5cm_5deg"], 3);
  EXPECT_THAT(found.err, HasSubstr("--align: fewer than 3 frames localized in " + at("far0.sphc")));
  EXPECT_THAT(found.err, HasSubstr("--trajectory: its poses are of 2 maps; a map that spherecloud map made"));
}

TEST_F(MapTest, TheScoreComparesWithThePosesOfTheRecording) {
  const Answer mapped = runCommand("map -r " + at("walk") + " --model " + at("walk.model") + " --score --json");
  ASSERT_EQ(mapped.exit_code, kExitDone) << mapped.err;
  const auto summary = nlohmann::json::parse(mapped.out);
  EXPECT_EQ(summary["frames_mapped"], 10);
  EXPECT_EQ(summary["parts"], 1);
  EXPECT_LT(summary["score"]["rigid_rmse_m"], 0.01);
  EXPECT_NEAR(summary["score"]["scale"], 1, 0.02);
  EXPECT_GT(summary["residuals_of_poses"]["ray_sigmas"], 0.05);
  EXPECT_LT(summary["residuals_of_poses"]["ray_sigmas"], 1);
  EXPECT_LT(summary["score"]["rotation_worst_deg"], 5);  // aligned by places on a path of a step
  expectExplained(summary);
}

TEST_F(MapTest, PosesOfAnotherScaleThanTheDepthsAreNamed) {
  fs::copy(at("walk"), at("large"), fs::copy_options::recursive);
  std::ifstream from(at("walk/groundtruth.txt"));
  std::ofstream to(at("large/groundtruth.txt"));
  for (std::string line; std::getline(from, line);) {
    if (line[0] == '#') continue;
    std::istringstream words(line);
    std::string time, rotation;
    double x, y, z;
    words >> time >> x >> y >> z;
    std::getline(words, rotation);
    to << time << " " << 1.3 * x << " " << 1.3 * y << " " << 1.3 * z << rotation << "\n";
  }
  to.close();
  const std::string map = " --model " + at("scale.model") + " --score --json";
  EXPECT_THAT(runCommand("map -r " + at("large") + map).err, HasSubstr("depth_unit_m"));
  EXPECT_THAT(runCommand("map -r " + at("walk") + map + " --force").err, Not(HasSubstr("depth_unit_m")));
}

TEST_F(MapTest, PosesThatAreInversesAreNamed) {
  fs::copy(at("walk"), at("inverse"), fs::copy_options::recursive);
  const recording::RecordingReader reader(at("walk"));
  std::ofstream inverse(at("inverse/groundtruth.txt"));
  for (const recording::TimedPose &timed : reader.recording().poses.poses()) {
    const sphc_rigid pose = rigidToC(rigidFromC(timed.pose).inverse());
    const double *q = pose.q_wxyz, *t = pose.t_m;
    inverse << recording::formatSeconds(timed.time_ns) << " "
            << recording::formatNumbers({t[0], t[1], t[2], q[1], q[2], q[3], q[0]}) << "\n";
  }
  inverse.close();
  const std::string map = " --model " + at("inverse.model") + " --score --json --force";
  const Answer named = runCommand("map -r " + at("inverse") + map);
  EXPECT_EQ(named.exit_code, kExitDone);
  EXPECT_THAT(named.err, HasSubstr("are inverses, camera_from_world; the score expects world_from_camera"));
  EXPECT_THAT(named.err, Not(HasSubstr("depth_unit_m")));
  EXPECT_THAT(runCommand("map -r " + at("walk") + map).err, Not(HasSubstr("inverses")));
  const Answer told = runCommand("map -r " + at("inverse") + map + " --poses approximate");
  EXPECT_THAT(told.err, HasSubstr("are they of this recording, world_from_camera, and in metres?"));
  expectExplained(nlohmann::json::parse(told.out));
}

// A walk of which all but the first frames show nothing.
void writeBlindWalk(const std::string &walk, const std::string &blind, uint32_t seeing) {
  recording::RecordingReader reader(walk);
  sphc_recording_writer *writer = nullptr;
  ASSERT_EQ(sphc_recording_create(blind.c_str(), &reader.calibration(), &writer, nullptr), SPHC_OK);
  for (uint32_t i = 0; i < reader.frameCount(); ++i) {
    sphc_localizer_frame frame = reader.read(i);
    const std::vector<uint8_t> blank(size_t{frame.color.stride_bytes} * frame.color.height, 90);
    if (i >= seeing) frame.color.data = blank.data();
    ASSERT_EQ(sphc_recording_add_frame(writer, &frame, nullptr), SPHC_OK);
  }
  ASSERT_EQ(sphc_recording_close(&writer, nullptr), SPHC_OK);
}

TEST_F(MapTest, AModelOfLessThanAThirdOfTheFramesIsNotWritten) {
  writeBlindWalk(at("walk"), at("blind3"), 3);
  const Answer lost = runCommand("map -r " + at("blind3") + " --model " + at("blind3.model"));
  EXPECT_EQ(lost.exit_code, kExitFailure);
  EXPECT_THAT(lost.err,
              HasSubstr("only 3 of 10 frames found a place, fewer than a third, so no model was written"));
  EXPECT_THAT(lost.err, HasSubstr("walk once more"));
  EXPECT_THAT(lost.err, HasSubstr("left out: ")) << "and why";
  EXPECT_FALSE(fs::exists(at("blind3.model")));
  writeBlindWalk(at("walk"), at("blind4"), 4);
  const Answer found = runCommand("map -r " + at("blind4") + " --model " + at("blind4.model"));
  EXPECT_EQ(found.exit_code, kExitDone) << found.err;
  const Answer few =
      runCommand("map -r " + at("blind4") + " --min-observations 5 --force --model " + at("blind4.model"));
  EXPECT_EQ(few.exit_code, kExitUsage);
  EXPECT_THAT(few.err, HasSubstr("in so many of 4 frames that found a place; give a smaller number"));
  // A part that is chosen is all of the walk.
  EXPECT_EQ(runCommand("map -r " + at("blind3") + " --last 2 --model " + at("blind3.model")).exit_code, kExitDone);
}

// A wrong calibration is a reason to refine it, and one why nothing agrees.
TEST_F(MapTest, WhereNothingAgreesWhatWasMeasuredIsSaidWhileACalibrationIsRefinedToo) {
  writeBlindWalk(at("walk"), at("blind1"), 1);
  const Answer refused = runCommand("map -r " + at("blind1") + " --last 3 --model " + at("blind1.model") +
                                    " --refine-calibration " + at("blind1.json"));
  EXPECT_EQ(refused.exit_code, kExitFailure);
  EXPECT_THAT(refused.err, HasSubstr("no two frames of the walk agree"));
  EXPECT_THAT(refused.err, HasSubstr("note: left out: 0.0 to 0.6 s (4 frames)")) << "the first one too";
}

// Focal length and principal point are off in the file that the tool is given.
// Depth is three frames late: `build` refuses the recording, and knows nothing of it where it gets the model alone.
TEST_F(MapTest, AWalkThatContradictsItselfIsNotForPublishing) {
  ASSERT_EQ(runCommand("simulate --frames 24 --rate 6 --seed 6001 --out " + at("late")).exit_code, kExitDone);
  std::istringstream list(folder_->read("late/depth.txt"));
  std::string late, line;
  std::vector<std::string> images;
  while (std::getline(list, line)) {
    if (line.front() == '#') continue;
    const size_t space = line.find(' ');
    images.push_back(line.substr(space));
    late += line.substr(0, space) + images[images.size() < 4 ? 0 : images.size() - 4] + "\n";
  }
  folder_->write("late/depth.txt", late);
  const Answer mapped = runCommand("map -r " + at("late") + " --model " + at("late.model"));
  EXPECT_EQ(mapped.exit_code, kExitFailure);
  EXPECT_THAT(mapped.err, HasSubstr("this walk contradicts itself:\n  depth and colour disagree in "));
  EXPECT_THAT(mapped.err, HasSubstr("Do not publish it"));
  EXPECT_TRUE(fs::exists(at("late.model"))) << "an hour of work may be in it";
}

TEST_F(MapTest, ACalibrationThatIsOffIsRefined) {
  sphc_rig rig = recording::readCalibration(at("walk/calibration.json"));
  const double fx = rig.color_camera.params[0], cx = rig.color_camera.params[2];
  rig.color_camera.params[0] *= 1.02;
  rig.color_camera.params[1] *= 1.02;
  rig.color_camera.params[2] += 5;
  recording::writeCalibration(at("off.json"), rig);
  const std::string map = "map -r " + at("walk") + " --calibration " + at("off.json") + " --model " +
                          at("off.model") + " --refine-calibration " + at("refined.json") + " --json";
  const Answer mapped = runCommand(map);
  ASSERT_EQ(mapped.exit_code, kExitDone) << mapped.err;
  EXPECT_THAT(mapped.err, HasSubstr("10 frames that found a place may be too few to refine a calibration by"));
  const sphc_rig refined = recording::readCalibration(at("refined.json"));
  EXPECT_LT(std::abs(refined.color_camera.params[0] / fx - 1), 0.01);
  EXPECT_LT(std::abs(refined.color_camera.params[2] - cx), 3);
  EXPECT_GT(nlohmann::json::parse(mapped.out)["refined_calibration"]["color_px"], 1);
  // A calibration may be somebody's measurement: none is replaced.
  EXPECT_THAT(runCommand(map).err, HasSubstr("--force"));
}

// Adds the images of another walk, so many seconds later.
void append(const std::string &walk, const std::string &other, double later_s) {
  for (const std::string kind : {"rgb", "depth"}) {
    std::ifstream from(other + "/" + kind + ".txt");
    std::ofstream to(walk + "/" + kind + ".txt", std::ios::app);
    for (std::string line; std::getline(from, line);) {
      if (line[0] == '#') continue;
      const size_t space = line.find(' ');
      const std::string name = kind + "/other_" + fs::path(line.substr(space + 1)).filename().string();
      fs::copy(other + "/" + line.substr(space + 1), walk + "/" + name);
      to << std::to_string(std::stod(line) + later_s) << " " << name << "\n";
    }
  }
}

// And its poses.
void appendPoses(const std::string &walk, const std::string &other, double later_s) {
  std::ifstream from(other + "/groundtruth.txt");
  std::ofstream to(walk + "/groundtruth.txt", std::ios::app);
  for (std::string line; std::getline(from, line);)
    if (line[0] != '#') to << std::to_string(std::stod(line) + later_s) << line.substr(line.find(' ')) << "\n";
}

TEST_F(MapTest, PartsThatNeverMetAreNamedAndTheStatusSaysSo) {
  const Answer other = runCommand("simulate --frames 6 --rate 5 --seed 9 --out " + at("other"));
  ASSERT_EQ(other.exit_code, kExitDone) << other.err;
  fs::copy(at("walk"), at("both"), fs::copy_options::recursive);
  append(at("both"), at("other"), 100);
  const Answer mapped = runCommand("map -r " + at("both") + " --model " + at("both.model") + " --json");
  EXPECT_EQ(mapped.exit_code, kExitWalkApart) << mapped.err;
  EXPECT_THAT(mapped.err, HasSubstr("10 of 16 frames: 0.0 to 1.8 s"));
  EXPECT_THAT(mapped.err, HasSubstr("never met 100.0 to 101.0 s (6 frames)"));
  EXPECT_THAT(mapped.err, HasSubstr("gap in time (no frame for 98.2 s): go back"));
  EXPECT_THAT(mapped.err, HasSubstr("no frame was taken from 1.8 to 100.0 s"));
  const auto summary = nlohmann::json::parse(mapped.out);
  EXPECT_EQ(summary["parts"], 2);
  EXPECT_EQ(summary["frames_mapped"], 10);
  // Odometry that was lost in between joins nothing.
  appendPoses(at("both"), at("other"), 100);
  EXPECT_EQ(runCommand("map -r " + at("both") + " --poses odometry --force --model " + at("both.model")).exit_code,
            kExitWalkApart);
}

TEST_F(MapTest, WhatOdometryAloneJoinsIsNamed) {
  const Answer other = runCommand("simulate --frames 6 --rate 5 --seed 9 --out " + at("joined"));
  ASSERT_EQ(other.exit_code, kExitDone) << other.err;
  fs::copy(at("walk"), at("long"), fs::copy_options::recursive);
  append(at("long"), at("joined"), 2.3);
  appendPoses(at("long"), at("joined"), 2.3);
  const Answer mapped =
      runCommand("map -r " + at("long") + " --poses odometry --model " + at("long.model") + " --json");
  EXPECT_EQ(mapped.exit_code, kExitDone) << mapped.err;
  EXPECT_THAT(mapped.err,
              HasSubstr("note: only the odometry joins 2.3 to 3.3 s (6 frames) to the rest of the map"));
  EXPECT_EQ(nlohmann::json::parse(mapped.out)["poses"]["alone"][0]["frames"], 6);
}

TEST_F(MapTest, TimesThatGoBackwardsAreRefusedWithTheirPlace) {
  fs::copy(at("walk"), at("backwards"), fs::copy_options::recursive);
  std::ifstream from(at("walk/rgb.txt"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(from, line);) lines.push_back(line);
  std::swap(lines[lines.size() - 3], lines[lines.size() - 4]);
  std::ofstream to(at("backwards/rgb.txt"));
  for (const std::string &line : lines) to << line << "\n";
  to.close();
  const Answer refused = runCommand("map -r " + at("backwards") + " --model " + at("backwards.model"));
  EXPECT_EQ(refused.exit_code, kExitFailure);
  EXPECT_THAT(refused.err, HasSubstr("rgb.txt, line " + std::to_string(lines.size() - 2)));
  EXPECT_THAT(refused.err, HasSubstr("time does not increase; sort the list"));
}

TEST_F(MapTest, ImagesThatChangeTheirSizeAreLeftOutAndNamed) {
  contract::writeTinyRecording(at("tiny"), 1);
  fs::copy(at("walk"), at("sizes"), fs::copy_options::recursive);
  const fs::path tiny = fs::directory_iterator(at("tiny/rgb"))->path();
  std::vector<fs::path> images;
  for (const auto &image : fs::directory_iterator(at("sizes/rgb"))) images.push_back(image.path());
  fs::copy_file(tiny, images[0], fs::copy_options::overwrite_existing);
  const std::string map = "map -r " + at("sizes") + " --json --force --model " + at("sizes.model");
  const Answer mapped = runCommand(map);
  ASSERT_EQ(mapped.exit_code, kExitDone) << mapped.err;
  EXPECT_EQ(nlohmann::json::parse(mapped.out)["frames_mapped"], 9);
  EXPECT_THAT(mapped.err, HasSubstr("1 frame could not be read; the first: "));
  EXPECT_THAT(mapped.err, HasSubstr("48 x 32"));
  for (const fs::path &image : images) fs::copy_file(tiny, image, fs::copy_options::overwrite_existing);
  EXPECT_THAT(runCommand(map).err, HasSubstr("not one frame can be read"));
}

TEST_F(MapTest, ApproximatePosesKeepTheirWorld) {
  const Answer mapped = runCommand("map -r " + at("walk") + " --poses approximate --pose-sigma 0.02 --model " +
                                   at("told.model") + " --score --json");
  ASSERT_EQ(mapped.exit_code, kExitDone) << mapped.err;
  const auto summary = nlohmann::json::parse(mapped.out);
  EXPECT_EQ(summary["poses"]["told"], 10);
  EXPECT_TRUE(summary["poses"]["used"]);
  EXPECT_LT(summary["score"]["unaligned_rmse_m"], 0.02);
}

// Poses of a file stand for those of the recording, and are of no use to another.
TEST_F(MapTest, PosesComeFromAFileAndAreCheckedAgainstTheImages) {
  std::ofstream(at("wrong.tum")) << "1 0 0 0 0 0 0 1\n1.2 50 0 0 0 0 0 1\n1.4 0 90 0 0 0 0 1\n1.6 0 0 70 0 0 0 1\n";
  const std::string map = "map -r " + at("walk") + " --model " + at("file.model") + " --force";
  const Answer wrong = runCommand(map + " --poses odometry --poses-from " + at("wrong.tum") + " --score --json");
  ASSERT_EQ(wrong.exit_code, kExitDone) << wrong.err;
  EXPECT_THAT(wrong.err, HasSubstr("contradict the recording's poses altogether"));
  EXPECT_THAT(wrong.err, Not(HasSubstr("first frame's camera"))) << "it was to be nothing else";
  EXPECT_LT(nlohmann::json::parse(wrong.out)["score"]["rigid_rmse_m"], 0.01);
  EXPECT_THAT(runCommand(map + " --poses odometry --upright --poses-from " + at("wrong.tum")).err,
              HasSubstr("so none was used, and the world is the first frame's camera"));
  std::ofstream(at("late.tum")) << "500 0 0 0 0 0 0 1\n";
  EXPECT_THAT(runCommand(map + " --poses odometry --poses-from " + at("late.tum")).err,
              HasSubstr("no pose is of the time of a frame"));
  EXPECT_EQ(runCommand(map + " --poses-from " + at("late.tum")).exit_code, kExitUsage);
  EXPECT_EQ(runCommand(map + " --upright").exit_code, kExitUsage);
}

// What cannot be used is known before images are read, and before a calibration is fitted and written.
TEST_F(MapTest, PosesThatAreOfNoUseAreNamedFirst) {
  std::ofstream(at("years.tum")) << "500 0 0 0 0 0 0 1\n";
  std::ofstream(at("nothing.tum")) << "1 nan 0 0 0 0 0 1\n1.2 0 0 0 0 0 0 0\n";
  const std::string map =
      "map -r " + at("walk") + " --model " + at("early.model") + " --poses odometry --poses-from ";
  const Answer refined = runCommand(map + at("years.tum") + " --refine-calibration " + at("early.json"));
  EXPECT_EQ(refined.exit_code, kExitFailure);
  EXPECT_THAT(refined.err, HasSubstr("no pose is of the time of a frame"));
  EXPECT_FALSE(fs::exists(at("early.json")));
  const Answer bad = runCommand(map + at("nothing.tum"));
  EXPECT_EQ(bad.exit_code, kExitFailure);
  EXPECT_THAT(bad.err, HasSubstr("nothing.tum: left out: 2 poses, unknown, no rotation"));
}

// The larger part has no poses, so those of the smaller one hold nothing.
TEST_F(MapTest, PosesOfAnotherPartDoNotStopTheMap) {
  const Answer other = runCommand("simulate --frames 6 --rate 5 --seed 9 --out " + at("small"));
  ASSERT_EQ(other.exit_code, kExitDone) << other.err;
  std::ofstream(at("none.tum")) << "500 0 0 0 0 0 0 1\n";
  const Answer mapped = runCommand("map -r " + at("walk") + " -r " + at("small") +
                                   " --poses approximate --poses-from " + at("none.tum") + " --poses-from " +
                                   at("small/groundtruth.txt") + " --model " + at("larger.model") + " --json");
  EXPECT_EQ(mapped.exit_code, kExitWalkApart) << mapped.err;
  EXPECT_THAT(mapped.err, HasSubstr("no pose is of the time of a frame of " + at("walk")));
  EXPECT_THAT(mapped.err, HasSubstr("the poses are of frames that are not in the map, so none was used"));
  EXPECT_THAT(mapped.err, Not(HasSubstr("contradict")));
  const auto summary = nlohmann::json::parse(mapped.out);
  EXPECT_EQ(summary["frames_mapped"], 10);
  EXPECT_EQ(summary["poses"]["used"], false);
}

// The walk as a ROS bag with an accelerometer, of which the transform may be wrong by a quarter turn about the
// view.
std::string bagOfWalk(const std::string &walk, double gravity_mps2) {
  constexpr int64_t kStepNs = 400000000;
  recording::RecordingReader reader(walk);
  const sphc_rig &rig = reader.calibration();
  test::RosBag bag;
  const std::string type = "sensor_msgs/msg/";
  for (const auto &[name, camera] : {std::pair("color", rig.color_camera), {"depth", rig.depth_camera}}) {
    const double *p = camera.params;
    const std::vector<double> distortion =
        camera.model == SPHC_CAMERA_PINHOLE ? std::vector<double>(5) : std::vector<double>(p + 4, p + 9);
    bag.add("/" + std::string(name) + "/camera_info", type + "CameraInfo", 1,
            test::rosCameraInfo(name, camera.width, camera.height, "plumb_bob", distortion,
                                {p[0], p[1], p[2] - 0.5, p[3] - 0.5}));
  }
  const sphc_rigid same = {{1, 0, 0, 0}, {0, 0, 0}};
  bag.add("/tf_static", "tf2_msgs/msg/TFMessage", 1,
          test::rosTransforms(0, {{"color", "depth", rig.color_from_depth}, {"color", "imu", same}}));
  for (uint32_t i = 0; i < reader.frameCount(); ++i) {
    const sphc_localizer_frame frame = reader.read(i);
    const auto pixels = [](const sphc_image &image) {
      const auto *begin = static_cast<const uint8_t *>(image.data);
      return test::Bytes(begin, begin + size_t{image.stride_bytes} * image.height);
    };
    const int64_t time_ns = 1000000000 + i * kStepNs;
    bag.add("/color/image_raw", type + "Image", 1,
            test::rosImage(time_ns, "color", frame.color.width, frame.color.height, "bgr8", pixels(frame.color)));
    bag.add("/depth/image_raw", type + "Image", 1,
            test::rosImage(time_ns, "depth", frame.depth.width, frame.depth.height, "16UC1", pixels(frame.depth)));
    const Vector3 up = rigidFromC(*reader.worldFromCamera(i)).rotation.transpose() * Vector3(0, 0, gravity_mps2);
    bag.add("/imu", type + "Imu", 1, test::rosImu(time_ns, "imu", {up.x(), up.y(), up.z()}));
  }
  return bag.bytes(test::RosBag::Chunks::kZstd);
}

TEST_F(MapTest, AccelerationsTurnTheMapUpright) {
  std::ofstream(at("imu.mcap"), std::ios::binary) << bagOfWalk(at("walk"), 9.81);
  const Answer mapped = runCommand("map -r " + at("imu.mcap") + " --model " + at("imu.model") + " --trajectory " +
                                   at("imu.tum") + " --json");
  ASSERT_EQ(mapped.exit_code, kExitDone) << mapped.err;
  const auto summary = nlohmann::json::parse(mapped.out);
  EXPECT_EQ(summary["vertical"]["used"], true);
  EXPECT_EQ(summary["vertical"]["accelerations"], 10);
  uint32_t bad = 0;
  const recording::PoseTrack found = recording::readTumPoses(at("imu.tum"), &bad);
  recording::RecordingReader truth(at("walk"));
  ASSERT_EQ(found.poses().size(), truth.frameCount());
  for (uint32_t i = 0; i < truth.frameCount(); ++i) {
    const Vector3 up_camera = rigidFromC(*truth.worldFromCamera(i)).rotation.transpose() * Vector3::UnitZ();
    EXPECT_GT((rigidFromC(found.poses()[i].pose).rotation * up_camera).z(), std::cos(0.01)) << i;
  }
}

// They give no world, so it is upright all the same.
TEST_F(MapTest, AccelerationsStandInForPosesThatAreNotBelieved) {
  std::ofstream(at("felt.mcap"), std::ios::binary) << bagOfWalk(at("walk"), 9.81);
  std::ofstream wrong(at("felt.tum"));
  for (int i = 0; i < 10; ++i) wrong << 1 + 0.4 * i << " " << 50 * i * i << " 0 0 0 0 0 1\n";
  wrong.close();
  const Answer mapped = runCommand("map -r " + at("felt.mcap") + " --poses approximate --poses-from " +
                                   at("felt.tum") + " --model " + at("felt.model") + " --json");
  ASSERT_EQ(mapped.exit_code, kExitDone) << mapped.err;
  EXPECT_THAT(mapped.err, HasSubstr("so none was used, and the world has its up from the accelerations alone"));
  EXPECT_EQ(nlohmann::json::parse(mapped.out)["vertical"]["used"], true);
}

TEST_F(MapTest, AccelerationsOfOtherUnitsAreNamedAlsoInACopy) {
  std::ofstream(at("bag.mcap"), std::ios::binary) << bagOfWalk(at("walk"), 1);
  ASSERT_EQ(runCommand("convert " + at("bag.mcap") + " " + at("units.mcap")).exit_code, kExitDone);
  const Answer mapped = runCommand("map -r " + at("units.mcap") + " --model " + at("units.model"));
  ASSERT_EQ(mapped.exit_code, kExitDone) << mapped.err;
  EXPECT_THAT(mapped.err, HasSubstr("note: the accelerations do not tell the vertical: their mean is 1.0 m/s^2"));
  EXPECT_THAT(mapped.out, Not(HasSubstr("up is +z")));
}

TEST_F(MapTest, SeveralRecordingsBecomeOneMapAndAStrangerIsNamed) {
  const Answer again = runCommand("simulate --frames 8 --rate 5 --walk-seed 4 --out " + at("again"));
  ASSERT_EQ(again.exit_code, kExitDone) << again.err;
  const Answer stranger = runCommand("simulate --frames 6 --rate 5 --seed 9 --out " + at("stranger"));
  ASSERT_EQ(stranger.exit_code, kExitDone) << stranger.err;
  const std::string three = "map -r " + at("walk") + " -r " + at("again") + " -r " + at("stranger") + " --model " +
                            at("three.model") + " --json";
  const std::string files = " --trajectory " + at("1.tum") + " --trajectory " + at("2.tum");
  EXPECT_EQ(runCommand(three + files).exit_code, kExitUsage);
  const Answer mapped = runCommand(three + files + " --trajectory " + at("3.tum") + " --score");
  EXPECT_EQ(mapped.exit_code, kExitWalkApart);
  EXPECT_THAT(mapped.err, HasSubstr("stranger never met the others: none of its 6 frames"));
  EXPECT_THAT(mapped.err, Not(HasSubstr("It never met"))) << "which has another cure";
  const auto recordings = nlohmann::json::parse(mapped.out)["recordings"];
  ASSERT_EQ(recordings.size(), 3u);
  EXPECT_EQ(recordings[0]["frames_mapped"], 10);
  EXPECT_EQ(recordings[1]["frames_mapped"], 8);
  EXPECT_EQ(recordings[2]["frames_mapped"], 0);
  EXPECT_LT(recordings[1]["score"]["rigid_rmse_m"], 0.01);
  EXPECT_FALSE(recordings[2].contains("score"));
  EXPECT_EQ(recordings[1]["trajectory"], at("2.tum"));
  std::ifstream second(at("2.tum"));
  EXPECT_EQ(std::count(std::istreambuf_iterator<char>(second), {}, '\n'), 9);
}

TEST_F(MapTest, WhatCannotBeMappedIsRefusedWithItsCure) {
  const Answer alone = runCommand("map -r " + at("walk") + " --last 0 --model " + at("one.model"));
  EXPECT_EQ(alone.exit_code, kExitFailure);
  EXPECT_THAT(alone.err, HasSubstr("the walk has one frame"));
  EXPECT_FALSE(fs::exists(at("one.model")));
  const Answer missing = runCommand("map -r " + at("nowhere") + " --model " + at("x.model"));
  EXPECT_THAT(missing.err, HasSubstr("cannot open the recording"));
  // Of several, the one that is at fault.
  writeBlindWalk(at("walk"), at("blind0"), 0);
  const Answer blind = runCommand("map -r " + at("walk") + " -r " + at("blind0") + " --model " + at("x.model"));
  EXPECT_EQ(blind.exit_code, kExitFailure);
  EXPECT_THAT(blind.err, HasSubstr(at("blind0") + ": no keypoint has depth"));
}

// The walk as if it had been recorded so many seconds later.
void copyLater(const std::string &walk, const std::string &later, double seconds) {
  fs::copy(walk, later, fs::copy_options::recursive);
  for (const std::string list : {"rgb.txt", "depth.txt"}) {
    std::ifstream from(walk + "/" + list);
    std::ofstream to(later + "/" + list);
    for (std::string line; std::getline(from, line);)
      if (line[0] != '#') to << std::to_string(std::stod(line) + seconds) << line.substr(line.find(' ')) << "\n";
  }
}

TEST_F(MapTest, TheOldestRecordingComesFirst) {
  copyLater(at("walk"), at("monday"), 1.7e9);
  copyLater(at("walk"), at("friday"), 1.7e9 + 4 * 86400);
  const Answer wrong =
      runCommand("map -r " + at("friday") + " -r " + at("monday") + " --model " + at("order.model"));
  EXPECT_EQ(wrong.exit_code, kExitUsage);
  EXPECT_THAT(wrong.err, HasSubstr(at("monday") + " is older than " + at("friday") + ", by their times"));
  EXPECT_THAT(wrong.err, HasSubstr("give the oldest first"));
  // A clock that does not count from 1970 tells nothing of the order.
  for (const std::string &pair : {at("monday") + " -r " + at("friday"), at("friday") + " -r " + at("walk")}) {
    const Answer right = runCommand("map --last 1 --force -r " + pair + " --model " + at("order.model"));
    EXPECT_EQ(right.exit_code, kExitDone) << right.err;
  }
}

TEST_F(MapTest, ARecordingIsGivenOnce) {
  const Answer twice =
      runCommand("map -r " + at("walk") + " -r " + at("walk/../walk/") + " --model " + at("twice.model"));
  EXPECT_EQ(twice.exit_code, kExitUsage);
  EXPECT_THAT(twice.err, HasSubstr(at("walk/../walk/") + " are one recording; give each once"));
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
