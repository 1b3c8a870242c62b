#include "host/report/trajectory.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "frames.h"

namespace sphc::host {
namespace {

TEST(TumTrajectory, PutsTheRealPartLast) {
  const sphc_rigid pose = {{0.5, 0.1, 0.2, 0.3}, {1, -2, 3.25}};
  EXPECT_EQ(tumLine(1500000001, pose),
            "1.500000001 1.000000000 -2.000000000 3.250000000 0.100000000 0.200000000 0.300000000 0.500000000\n");
}

TEST(TumTrajectory, KeepsNanosecondsOfAbsoluteTimes) {
  EXPECT_EQ(tumLine(1305031102175304000, poseAt(0, 0, 0)).substr(0, 20), "1305031102.175304000");
  EXPECT_EQ(tumLine(-1500000000, poseAt(0, 0, 0)).substr(0, 12), "-1.500000000");
}

TEST(TumTrajectory, HasLocalizedFramesOnly) {
  host::Run run;
  run.base = "world";
  run.frames = {goodFrame(1, 0, 0), lostFrame(2), goodFrame(3, 0, 0)};
  const std::string text = tumTrajectory(run);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);
  EXPECT_NE(text.find("# timestamp tx ty tz qx qy qz qw (world_from_camera, metres, by spherecloud localize)\n0.1"),
            std::string::npos);
  EXPECT_NE(text.find("\n0.300000000 "), std::string::npos);
}

}  // namespace
}  // namespace sphc::host
