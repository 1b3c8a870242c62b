#include <gtest/gtest.h>

#include "spherecloud/spherecloud.hpp"
#include "tests/capi/bytes.h"
#include "tests/support/session.h"
#include "tests/support/spoiled_rigs.h"

namespace {

using sphc::test::Output;
using sphc::test::SpoiledRig;
using sphc::test::spoiledRigs;

sphc_rig goodRig() { return sphc::test::sceneConfig().rig; }

TEST(CInterfaceRig, InitLeavesOnlyTheCameras) {
  sphc_rig_init(nullptr);
  sphc_rig rig = spherecloud::defaultRig();
  EXPECT_EQ(sphc_rig_check(&rig, nullptr), SPHC_E_ARGUMENT);
  rig.color_camera = rig.depth_camera = sphc::test::pinhole(640, 480, 500);
  EXPECT_EQ(sphc_rig_check(&rig, nullptr), SPHC_OK);
  EXPECT_EQ(rig.color_from_depth.q_wxyz[0], 1);
  EXPECT_EQ(rig.depth_unit_m, 0.001);
}

TEST(CInterfaceRig, CheckExplains) {
  sphc_message message = {};
  EXPECT_EQ(sphc_rig_check(nullptr, &message), SPHC_E_ARGUMENT);
  EXPECT_STREQ(message.text, "rig is null; give one");
  for (const SpoiledRig &spoiled : spoiledRigs()) {
    sphc_rig rig = goodRig();
    spoiled.spoil(&rig);
    EXPECT_EQ(sphc_rig_check(&rig, &message), SPHC_E_ARGUMENT) << spoiled.message;
    EXPECT_STREQ(message.text, spoiled.message);
    EXPECT_EQ(sphc_rig_check(&rig, nullptr), SPHC_E_ARGUMENT);
  }
  Output<sphc_message> untouched;
  const sphc_rig good = goodRig();
  EXPECT_EQ(sphc_rig_check(&good, untouched.get()), SPHC_OK);
  EXPECT_TRUE(untouched.untouched());
}

TEST(CInterfaceRig, LimitsAreTaken) {
  sphc_rig rig = goodRig();
  rig.color_camera = sphc::test::pinhole(SPHC_CAMERA_MIN_PX, SPHC_CAMERA_MAX_PX, SPHC_CAMERA_MAX_PARAM);
  rig.color_from_depth = {{1 + 0.99 * SPHC_RIG_MAX_LENGTH_ERROR, 0, 0, 0},
                          {SPHC_RIG_MAX_OFFSET_M, -SPHC_RIG_MAX_OFFSET_M, 0}};
  for (const double unit_m : {SPHC_RIG_MIN_UNIT_M, SPHC_RIG_MAX_UNIT_M}) {
    rig.depth_unit_m = unit_m;
    sphc_message message = {};
    EXPECT_EQ(sphc_rig_check(&rig, &message), SPHC_OK) << message.text;
  }
}

TEST(CInterfaceRig, LocalizerAndAlignerSayTheSame) {
  for (const SpoiledRig &spoiled : spoiledRigs()) {
    sphc_localizer_config config = sphc::test::sceneConfig();
    sphc_aligner_config aligning = spherecloud::defaultAlignerConfig();
    spoiled.spoil(&config.rig);
    aligning.rig = config.rig;
    sphc_message message = {};
    Output<sphc_memory> need;
    EXPECT_EQ(sphc_localizer_memory(&config, need.get(), &message), SPHC_E_ARGUMENT);
    EXPECT_STREQ(message.text, spoiled.message);
    EXPECT_TRUE(need.untouched());
    message = {};
    EXPECT_EQ(sphc_aligner_memory(&aligning, need.get(), &message), SPHC_E_ARGUMENT);
    EXPECT_STREQ(message.text, spoiled.message);
    EXPECT_TRUE(need.untouched());
  }
}

}  // namespace
