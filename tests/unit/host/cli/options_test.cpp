// Options go where their names say, in the unit that they are told in.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "command_runner.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/rig_options.h"
#include "host/cli/map_options.h"
#include "runtime/base/elementary.h"
#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

PoseTrust trustOf(const std::string &arguments) {
  CLI::App app;
  MapOptions options;
  addMapOptions(&app, &options);
  app.parse("-r walk --model room.model " + arguments);
  return options.mapping().trust;
}

TEST(MapOptionsTest, TrustInPosesIsInMetresAndRadians) {
  const PoseTrust approximate = trustOf("--poses approximate --pose-sigma 0.5 --pose-sigma-deg 60");
  EXPECT_DOUBLE_EQ(approximate.sigma_m, 0.5);
  EXPECT_DOUBLE_EQ(approximate.sigma_rad, kPi / 3);
  const PoseTrust odometry = trustOf("--poses odometry --drift 3 --drift-deg 45");
  EXPECT_DOUBLE_EQ(odometry.drift_m, 0.03);
  EXPECT_DOUBLE_EQ(odometry.drift_rad, kPi / 4);
  EXPECT_DOUBLE_EQ(odometry.sigma_m, PoseTrust().sigma_m);
}

TEST(RigOptionsTest, EachNumberIsTheOneThatItIsNamed) {
  CLI::App app;
  RigOptions options;
  addRigOptions(&app, &options);
  app.parse("--color c --depth d --calibration k --width 480 --height 360 --fps 15 --tolerance-ms 7");
  EXPECT_EQ(options.color, "c");
  EXPECT_EQ(options.depth, "d");
  EXPECT_EQ(options.wish.calibration, "k");
  EXPECT_EQ(options.wish.width, 480u);
  EXPECT_EQ(options.wish.height, 360u);
  EXPECT_EQ(options.wish.fps, 15u);
  EXPECT_EQ(options.tolerance_ms, 7);
}

// What a flag changes of a frame, and what it leaves.
TEST(SimulateOptionsTest, FlagsChangeColourOrDepthOrBoth) {
  const test::TempFolder folder;
  const auto simulate = [&folder](const std::string &name, const std::string &flag) {
    const Answer answer =
        runCommand("simulate --frames 1 --from 5 --no-blur --out " + (folder / name) + " " + flag);
    EXPECT_EQ(answer.exit_code, kExitDone) << answer.err;
    return std::pair(fileText(folder / name + "/rgb/000000.png"), fileText(folder / name + "/depth/000000.png"));
  };
  const auto [color, depth] = simulate("plain", "");
  const auto [ideal_color, ideal_depth] = simulate("ideal", "--ideal-depth");
  const auto [clear_color, clear_depth] = simulate("clear", "--no-noise");
  const auto [even_color, even_depth] = simulate("even", "--no-exposure-drift");
  const auto [other_color, other_depth] = simulate("other", "--arrangement 2");
  EXPECT_TRUE(ideal_color == color && ideal_depth != depth);
  EXPECT_LT(ideal_depth.size(), depth.size());
  EXPECT_TRUE(clear_color != color && clear_depth == depth);
  EXPECT_LT(clear_color.size(), color.size());
  EXPECT_TRUE(even_color != color && even_depth == depth);
  EXPECT_GT(even_color.size(), clear_color.size());
  EXPECT_TRUE(other_color != color && other_depth != depth);
}

}  // namespace
}  // namespace sphc::host
