// A rolling shutter from the simulated headset to a map, and to a pose.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "command_runner.h"
#include "host/cli/common/exit_code.h"
#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

using testing::HasSubstr;

const std::string kRowTime = " --row-time-ns 60000";  // 29 ms an image
const std::string kBrisk = "simulate --lap 10 --seed 8001 --walk-seed 8001 ";

class RollingShutterTest : public testing::Test {
 protected:
  std::string at(const std::string &name) const { return folder_ / name; }
  static Answer succeed(const std::string &command) {
    Answer answer = runCommand(command);
    EXPECT_EQ(answer.exit_code, kExitDone) << command << answer.err;
    return answer;
  }
  std::string build(const std::string &recording, const std::string &map) const {
    return "build --json -r " + at(recording) + " -m " + at(map) + " --ledger " + at(map + ".ledger");
  }
  std::string localize(const std::string &recording, const std::string &map) const {
    return "localize --json -r " + at(recording) + " -m " + at(map) + " --owner-note " + at(map + ".owner.json");
  }
  static double medianErrorM(const std::string &command) {
    return nlohmann::json::parse(succeed(command).out)["translation_error_m"]["median"];
  }

 private:
  test::TempFolder folder_;
};

// Ten frames of one lap, and some tenths of a second of the next.
TEST_F(RollingShutterTest, MapAndPoseAreExactWhereTheRowTimeIsTold) {
  succeed(kBrisk + "--frames 10 --rate 1 --poses 60 --out " + at("walk") + kRowTime);
  succeed(kBrisk + "--frames 10 --rate 30 --from 10.5 --out " + at("rolling") + kRowTime);
  succeed(kBrisk + "--frames 3 --rate 4 --from 10.5 --out " + at("at_once"));
  succeed(build("walk", "told.sphc") + kRowTime);
  succeed(build("walk", "untold.sphc"));
  const double of_map_m = medianErrorM(localize("at_once", "told.sphc"));
  EXPECT_GT(medianErrorM(localize("at_once", "untold.sphc")), 2 * of_map_m);
  const double of_query_m = medianErrorM(localize("rolling", "told.sphc") + kRowTime);
  EXPECT_GT(medianErrorM(localize("rolling", "told.sphc")), 2 * of_query_m);
}

TEST_F(RollingShutterTest, WhereTheMotionIsNotKnownThatIsSaid) {
  succeed(kBrisk + "--frames 3 --rate 4 --out " + at("walk") + kRowTime);
  const Answer built = succeed(build("walk", "room.sphc") + kRowTime);
  EXPECT_THAT(built.err, HasSubstr("the rows of 3 frames"));
  EXPECT_THAT(built.err, HasSubstr("at 20 Hz or more"));
  EXPECT_EQ(nlohmann::json::parse(built.out)["frames_bent"], 3) << built.out;
  EXPECT_EQ(nlohmann::json::parse(built.out)["row_time_ns"], 60000);
  const std::string note = "--row-time-ns: how the camera moves is not known";
  EXPECT_THAT(succeed(localize("walk", "room.sphc") + kRowTime + " --mode single").err, HasSubstr(note));
  const Answer tracked = succeed(localize("walk", "room.sphc") + kRowTime);
  EXPECT_THAT(tracked.err, testing::Not(HasSubstr(note)));
  EXPECT_EQ(nlohmann::json::parse(tracked.out)["settings"]["color_row_time_ns"], "60000");
}

// 4 Hz is just fast enough, every second frame of it is not.
TEST_F(RollingShutterTest, ThatFramesAreTooFarApartIsSaid) {
  succeed(kBrisk + "--frames 5 --rate 4 --out " + at("walk") + kRowTime);
  succeed(build("walk", "room.sphc"));
  const std::string localized = localize("walk", "room.sphc") + " --odometry";
  EXPECT_THAT(succeed(localized + kRowTime).err, testing::Not(HasSubstr("--row-time-ns")));
  EXPECT_THAT(succeed(localized + " --step 2").err, testing::Not(HasSubstr("--row-time-ns")));
  EXPECT_THAT(
      succeed(localized + " --step 2" + kRowTime).err,
      HasSubstr("not known between frames 0.50 s apart, with --odometry neither, so rows stay where they are"));
}

// Those of the images among them, each once.
TEST_F(RollingShutterTest, PosesComeFromBeforeTheFirstImageToAfterTheLast) {
  succeed(kBrisk + "--frames 2 --rate 3 --poses 30 --out " + at("walk"));
  std::istringstream lines(fileText(at("walk/groundtruth.txt")));
  std::vector<double> times_s;
  for (std::string line; std::getline(lines, line);)
    if (line[0] != '#') times_s.push_back(std::stod(line));
  ASSERT_EQ(times_s.size(), 16u);  // 0.1 s, 0.333 s and 0.1 s at 30 Hz
  EXPECT_TRUE(std::is_sorted(times_s.begin(), times_s.end(), std::less_equal<>()));
  EXPECT_NEAR(times_s.front(), 0.9, 1e-6);
  EXPECT_EQ(std::count(times_s.begin(), times_s.end(), 1.0), 1);
}

TEST_F(RollingShutterTest, ATimeThatNoCameraHasIsRefused) {
  succeed(kBrisk + "--frames 1 --out " + at("walk"));
  succeed(build("walk", "room.sphc"));
  for (const std::string &command :
       {localize("walk", "room.sphc"), build("walk", "y.sphc"), "simulate --out " + at("z")}) {
    const Answer refused = runCommand(command + " --row-time-ns 1000001");
    EXPECT_EQ(refused.exit_code, kExitUsage) << command << refused.err;
    EXPECT_THAT(refused.err, HasSubstr("--row-time-ns")) << command;
  }
}

}  // namespace
}  // namespace sphc::host
