#include "host/cameras/join.h"

#include <gmock/gmock.h>

#include "golden.h"
#include "tests/support/refusal.h"

namespace sphc::host {
namespace {

std::string refusal(const std::vector<CalibrationPart> &parts, const JoinOptions &options) {
  return test::refusal([&] { joinParts(parts, options); });
}

const sphc_rigid kBaseline = {{1, 0, 0, 0}, {0.1, 0, 0}};

struct RosParts {
  CalibrationPart color, depth, extrinsics;
};

RosParts rosParts() {
  RosParts parts = {readRos({"color.yaml", kRosColorFile}), readRos({"depth.yaml", kRosDepthFile}), {}};
  parts.extrinsics.second_from_first = kBaseline;
  return parts;
}

TEST(Join, FilesInTheOrderColourDepthExtrinsics) {
  const auto [color, depth, extrinsics] = rosParts();
  const sphc_rig joined = joinParts({color, depth, extrinsics}, {});
  EXPECT_EQ(joined.color_camera.width, 640u);
  EXPECT_EQ(joined.depth_camera.width, 320u);
  expectRigid(joined.color_from_depth, {1, 0, 0, 0}, {-0.1, 0, 0});
  EXPECT_EQ(joined.depth_unit_m, 0.001);
}

TEST(Join, NamesSwapTheCamerasAndTheTransform) {
  const auto [color, depth, extrinsics] = rosParts();
  JoinOptions options;
  options.color = "tof";
  options.depth = "narrow_stereo";
  const sphc_rig joined = joinParts({color, depth, extrinsics}, options);
  EXPECT_EQ(joined.color_camera.width, 320u);
  expectRigid(joined.color_from_depth, {1, 0, 0, 0}, {0.1, 0, 0});
}

TEST(Join, OptionsSayWhatFilesLeaveOpen) {
  const CalibrationPart color = readRos({"color.yaml", kRosColorFile}),
                        depth = readRos({"depth.yaml", kRosDepthFile});
  JoinOptions options;
  options.color_from_depth = kBaseline;
  options.depth_unit_m = 0.00025;
  const sphc_rig joined = joinParts({color, depth}, options);
  expectRigid(joined.color_from_depth, {1, 0, 0, 0}, {0.1, 0, 0});
  EXPECT_EQ(joined.depth_unit_m, 0.00025);
}

TEST(Join, RegisteredDepthNeedsOneCamera) {
  JoinOptions options;
  options.registered = true;
  const sphc_rig joined = joinParts({readRos({"color.yaml", kRosColorFile})}, options);
  EXPECT_EQ(joined.depth_camera.params[4], joined.color_camera.params[4]);
  expectRigid(joined.color_from_depth, {1, 0, 0, 0}, {0, 0, 0});
}

TEST(Join, ASizeThatTheFileLacksIsAskedFor) {
  const std::string text = changed(changed(kOpencvStereoFile, "image_width: 640\n", ""), "image_height: 480\n", "");
  const CalibrationPart part = readOpencv({"f", text});
  EXPECT_THAT(refusal({part}, {}), testing::HasSubstr("give --color-size WIDTHxHEIGHT"));
  JoinOptions options;
  options.color_size = {640, 480};
  EXPECT_THAT(refusal({part}, options), testing::HasSubstr("give --depth-size"));
  options.depth_size = {320, 240};
  EXPECT_EQ(joinParts({part}, options).depth_camera.height, 240u);
}

TEST(Join, ASizeThatTheFileHalfHasIsNotReplaced) {
  const std::string text = changed(kOpencvStereoFile, "image_height: 480\n", "");
  JoinOptions options;
  options.color_size = options.depth_size = {1280, 720};
  EXPECT_THAT(refusal({readOpencv({"f", text})}, options), testing::HasSubstr("camera '1' the width 640"));
  options.color_size = options.depth_size = {640, 480};
  EXPECT_EQ(joinParts({readOpencv({"f", text})}, options).depth_camera.height, 480u);
}

TEST(Join, WhatStandsTwiceIsNotChosenFrom) {
  using testing::HasSubstr;
  const auto [color, depth, extrinsics] = rosParts();
  JoinOptions options;
  options.color = color.cameras[0].name;
  options.depth = depth.cameras[0].name;
  EXPECT_THAT(refusal({color, depth, color, extrinsics}, options), HasSubstr("two cameras 'narrow_stereo'"));
  EXPECT_THAT(refusal({color, depth, extrinsics, extrinsics}, {}), HasSubstr("two of these files have R and T"));
}

TEST(Join, SaysWhatIsMissing) {
  using testing::HasSubstr;
  const auto [color, depth, extrinsics] = rosParts();
  EXPECT_THAT(refusal({extrinsics}, {}), HasSubstr("no camera"));
  EXPECT_THAT(refusal({color}, {}), HasSubstr("say --registered"));
  EXPECT_THAT(refusal({color, depth}, {}), HasSubstr("--color-from-depth QW,QX,QY,QZ,TX,TY,TZ"));
  EXPECT_THAT(refusal({color, depth, depth}, {}), HasSubstr("say with --color and --depth which to take"));
  JoinOptions options;
  options.color = "left";
  EXPECT_THAT(refusal({color, depth, extrinsics}, options),
              HasSubstr("no camera 'left' in these files; there are: 'narrow_stereo', 'tof'"));
  options.color = "tof";
  EXPECT_THAT(refusal({color, depth, extrinsics}, options), HasSubstr("cannot be both"));
  options = {};
  options.color_size = {1280, 720};
  EXPECT_THAT(refusal({color, depth, extrinsics}, options),
              HasSubstr("color images of 1280x720: camera 'narrow_stereo' is calibrated for 640x480"));
  options = {};
  options.depth_unit_m = 5;
  EXPECT_THAT(refusal({color, depth, extrinsics}, options), HasSubstr("depth_unit_m"));
}

TEST(Join, AnImpossibleCameraIsRefusedWhateverTheFormat) {
  CalibrationPart part = readKalibr({"f", changed(kKalibrFile, "461.629", "-461.629")});
  EXPECT_THAT(refusal({part}, {}), testing::HasSubstr("params[0] is -461.629; a focal length must be positive"));
  part = readKalibr({"f", changed(kKalibrFile, "461.629", "1.0e9")});
  EXPECT_THAT(refusal({part}, {}), testing::HasSubstr("at most 1000000"));
}

}  // namespace
}  // namespace sphc::host
