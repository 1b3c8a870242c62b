#include "host/live/geometry_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <memory>
#include <random>

#include "tests/unit/host/live/rendered_walk.h"

namespace sphc::host {
namespace {

constexpr uint32_t kWalkFrames = 4;  // far apart

Finding lookAt(const std::vector<WalkImages> &walk, const sphc_rig &calibration) {
  GeometryCheck check(calibration);
  const sphc_camera &c = calibration.color_camera, &d = calibration.depth_camera;
  for (const WalkImages &images : walk)
    check.look({images.color.data(), c.width, c.height, 3 * c.width, SPHC_FORMAT_RGB8},
               {images.depth.data(), d.width, d.height, 2 * d.width, SPHC_FORMAT_DEPTH16});
  return check.finding();
}

// A few views of the simulated room, rendered once.
class GeometryCheckTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { images_ = renderWalk(kWalkFrames, 0.5, &calibration_); }
  static void TearDownTestSuite() { images_.clear(); }

  using Spoil = std::function<void(std::vector<uint16_t> *depth)>;
  using SpoilColor = std::function<void(std::vector<uint8_t> *color)>;
  // `late`: so many frames, depth comes behind the image.
  Finding look(
      const sphc_rig &calibration, const Spoil &spoil = [](std::vector<uint16_t> *) {},
      const SpoilColor &spoil_color = [](std::vector<uint8_t> *) {}, size_t late = 0) {
    std::vector<WalkImages> walk = images_;
    for (size_t i = 0; i < walk.size(); ++i) {
      walk[i].depth = images_[(i + late) % images_.size()].depth;
      spoil(&walk[i].depth);
      spoil_color(&walk[i].color);
    }
    return lookAt(walk, calibration);
  }

  static sphc_rig calibration_;
  static std::vector<WalkImages> images_;
};
sphc_rig GeometryCheckTest::calibration_;
std::vector<WalkImages> GeometryCheckTest::images_;

TEST_F(GeometryCheckTest, ATrueCalibrationIsFine) {
  const Finding finding = look(calibration_);
  EXPECT_EQ(finding.grade, Finding::Grade::kFine) << finding.text;
}

TEST(GeometryCheckOfAPhone, EdgesOfCoarseDepthMayLieAPixelOfDepthApart) {
  sphc_rig calibration;
  const std::vector<WalkImages> walk = renderWalk(kWalkFrames, 0.5, &calibration, SPHC_SIMULATED_CAMERAS_PHONE);
  const Finding sound = lookAt(walk, calibration);
  EXPECT_EQ(sound.grade, Finding::Grade::kFine) << sound.text;
  std::vector<WalkImages> turned = walk;
  for (WalkImages &images : turned) std::reverse(images.depth.begin(), images.depth.end());
  const Finding half_a_turn = lookAt(turned, calibration);
  EXPECT_EQ(half_a_turn.grade, Finding::Grade::kWrong);
  EXPECT_NE(half_a_turn.text.find("half a turn"), std::string::npos) << half_a_turn.text;
  calibration.color_from_depth.t_m[0] = 0.04;
  const Finding beside = lookAt(walk, calibration);
  EXPECT_EQ(beside.grade, Finding::Grade::kDoubtful);
  EXPECT_NE(beside.text.find("at most 4 px are usual"), std::string::npos) << beside.text;
}

TEST(GeometryCheckOfOtherDevices, ATrueCalibrationIsNotWrong) {
  for (const uint32_t cameras : {SPHC_SIMULATED_CAMERAS_WIDE, SPHC_SIMULATED_CAMERAS_GLASSES}) {
    sphc_rig calibration;
    const std::vector<WalkImages> walk = renderWalk(20, 1.25, &calibration, cameras);
    const Finding sound = lookAt(walk, calibration);
    EXPECT_EQ(sound.grade, Finding::Grade::kFine) << sound.text;
  }
}

// By the light of one lamp.
TEST(GeometryCheckOfADimRoom, ATrueCalibrationIsNotWrongAndATurnedOneIs) {
  for (const uint64_t seed : {1u, 3u, 5u}) {
    sphc_rig calibration;
    std::vector<WalkImages> walk =
        renderWalk(kWalkFrames, 0.5, &calibration, SPHC_SIMULATED_CAMERAS_HEADSET, SPHC_SIMULATED_NIGHT, seed);
    const Finding sound = lookAt(walk, calibration);
    EXPECT_EQ(sound.grade, Finding::Grade::kFine) << seed << ": " << sound.text;
    for (WalkImages &images : walk) std::reverse(images.depth.begin(), images.depth.end());
    const Finding turned = lookAt(walk, calibration);
    EXPECT_EQ(turned.grade, Finding::Grade::kWrong) << seed << ": " << turned.text;
    EXPECT_NE(turned.text.find("half a turn"), std::string::npos) << seed << ": " << turned.text;
  }
}

// Depth of a wide lens, and a colour image that is a strip: as a calibration may be.
TEST(GeometryCheckOfAStrip, IsAnswered) {
  sphc_rig calibration;
  sphc_rig_init(&calibration);
  calibration.color_camera = {SPHC_CAMERA_PINHOLE, 8192, 16, 4, {6000, 6000, 4096, 8}};
  calibration.depth_camera = {SPHC_CAMERA_PINHOLE, 64, 16, 4, {50, 50, 32, 8}};
  const WalkImages images = {std::vector<uint8_t>(size_t{3} * 8192 * 16, 90), std::vector<uint16_t>(64 * 16, 2000)};
  EXPECT_EQ(lookAt({images}, calibration).grade, Finding::Grade::kDoubtful);
}

TEST_F(GeometryCheckTest, MirroringAndTurningAreNamed) {
  const uint32_t width = calibration_.depth_camera.width;
  const Finding mirrored = look(calibration_, [width](std::vector<uint16_t> *depth) {
    for (auto row = depth->begin(); row != depth->end(); row += width) std::reverse(row, row + width);
  });
  EXPECT_EQ(mirrored.grade, Finding::Grade::kWrong);
  EXPECT_NE(mirrored.text.find("mirrored"), std::string::npos) << mirrored.text;
  const Finding turned =
      look(calibration_, [](std::vector<uint16_t> *depth) { std::reverse(depth->begin(), depth->end()); });
  EXPECT_EQ(turned.grade, Finding::Grade::kWrong);
  EXPECT_NE(turned.text.find("half a turn"), std::string::npos) << turned.text;
}

// Boards before a wall, seen by two pinhole cameras of the same numbers; the colour camera stands 10 cm to the
// right.
Finding lookWithTwins(const sphc_rig &calibration, bool registered) {
  constexpr uint32_t kWidth = 320, kHeight = 240, kBoard = 30, kGap = 64;
  constexpr uint32_t kShift = 20;  // of the boards, 1.5 m away, in pixels
  std::vector<uint8_t> color(kWidth * kHeight, 40);
  std::vector<uint16_t> depth(kWidth * kHeight, 3000);
  for (uint32_t y = 16; y < kHeight - 16; ++y)
    for (uint32_t x = 40; x < kWidth - 40; ++x) {
      if (x % kGap >= kBoard || y % kGap >= kBoard) continue;
      color[y * kWidth + x - kShift] = 200;
      depth[y * kWidth + x - (registered ? kShift : 0)] = 1500;
    }
  GeometryCheck check(calibration);
  for (int i = 0; i < 4; ++i)
    check.look({color.data(), kWidth, kHeight, kWidth, SPHC_FORMAT_GRAY8},
               {depth.data(), kWidth, kHeight, 2 * kWidth, SPHC_FORMAT_DEPTH16});
  return check.finding();
}

TEST(GeometryCheckOfTwins, ATransformTheWrongWayRoundOrNotNeededIsNamed) {
  sphc_rig rig;
  sphc_rig_init(&rig);
  rig.color_camera = rig.depth_camera = {SPHC_CAMERA_PINHOLE, 320, 240, 4, {300, 300, 160, 120}};
  rig.color_from_depth.t_m[0] = -0.1;
  const Finding sound = lookWithTwins(rig, false);
  EXPECT_EQ(sound.grade, Finding::Grade::kFine) << sound.text;
  const Finding registered = lookWithTwins(rig, true);
  EXPECT_NE(registered.text.find("registered to colour"), std::string::npos) << registered.text;
  rig.color_from_depth.t_m[0] = 0.1;
  const Finding inverse = lookWithTwins(rig, false);
  EXPECT_EQ(inverse.grade, Finding::Grade::kWrong);
  EXPECT_NE(inverse.text.find("the wrong way round"), std::string::npos) << inverse.text;
}

TEST_F(GeometryCheckTest, ABlankWallTellsNothing) {
  const Finding finding = look(
      calibration_, [](std::vector<uint16_t> *depth) { std::fill(depth->begin(), depth->end(), uint16_t{2000}); });
  EXPECT_EQ(finding.grade, Finding::Grade::kDoubtful);
  EXPECT_NE(finding.text.find("too few edges"), std::string::npos) << finding.text;
}

TEST_F(GeometryCheckTest, ACalibrationInOtherUnitsIsNamed) {
  sphc_rig in_widths = calibration_, in_mm = calibration_;
  for (int i = 0; i < 4; ++i) in_widths.color_camera.params[i] /= in_widths.color_camera.width;
  for (double &value : in_mm.color_from_depth.t_m) value *= 200;  // the localizer takes no more than 10 m
  sphc_rig in_inches = calibration_;
  in_inches.depth_unit_m = 0.0254;
  for (const sphc_rig &wrong : {in_widths, in_mm, in_inches}) {
    const Finding finding = look(wrong);
    EXPECT_EQ(finding.grade, Finding::Grade::kWrong);
    EXPECT_NE(finding.text.find("depth_unit_m"), std::string::npos) << finding.text;
    EXPECT_NE(finding.text.find("in pixels"), std::string::npos) << finding.text;
  }
}

TEST_F(GeometryCheckTest, ABlackImageTellsNothing) {
  const Finding finding = look(
      calibration_, [](std::vector<uint16_t> *) {},
      [](std::vector<uint8_t> *color) { std::fill(color->begin(), color->end(), uint8_t{0}); });
  EXPECT_EQ(finding.grade, Finding::Grade::kDoubtful);
  EXPECT_NE(finding.text.find("too few edges in the image"), std::string::npos) << finding.text;
}

TEST_F(GeometryCheckTest, NoiseIsNotFine) {
  std::mt19937 random(1);
  const Finding colors = look(
      calibration_, [](std::vector<uint16_t> *) {},
      [&random](std::vector<uint8_t> *color) {
        for (uint8_t &value : *color) value = static_cast<uint8_t>(random());
      });
  EXPECT_EQ(colors.grade, Finding::Grade::kDoubtful);
  EXPECT_NE(colors.text.find("noise"), std::string::npos) << colors.text;
  const Finding depths = look(calibration_, [&random](std::vector<uint16_t> *depth) {
    for (uint16_t &value : *depth) value = static_cast<uint16_t>(500 + random() % 4000);
  });
  EXPECT_EQ(depths.grade, Finding::Grade::kWrong);
  EXPECT_NE(depths.text.find("noise"), std::string::npos) << depths.text;
}

TEST_F(GeometryCheckTest, DepthOfAnotherTimeIsNamedAndNotCalledTurned) {
  for (size_t late = 1; late < kWalkFrames; ++late) {
    const Finding finding = look(
        calibration_, [](std::vector<uint16_t> *) {}, [](std::vector<uint8_t> *) {}, late);
    EXPECT_EQ(finding.grade, Finding::Grade::kWrong);
    EXPECT_NE(finding.text.find("stale"), std::string::npos) << finding.text;
  }
}

}  // namespace
}  // namespace sphc::host
