#include "runtime/capi/defaults.h"

#include <gtest/gtest.h>

namespace sphc {
namespace {

TEST(Defaults, OneDepthSensorIsMeantByAll) {
  const sphc_localizer_config localizer = defaultConfig();
  const sphc_aligner_config aligner = defaultAlignerConfig();
  const sphc_localizer_depth_camera camera = emptyDepthCamera();
  EXPECT_EQ(aligner.depth_min_m, localizer.depth_min_m);
  EXPECT_EQ(camera.min_m, localizer.depth_min_m);
  EXPECT_EQ(aligner.depth_max_m, localizer.depth_max_m);
  EXPECT_EQ(camera.max_m, localizer.depth_max_m);
  EXPECT_EQ(aligner.depth_sigma_per_m2, localizer.depth_sigma_per_m2);
  EXPECT_EQ(camera.sigma_per_m2, localizer.depth_sigma_per_m2);
  EXPECT_EQ(camera.unit_m, localizer.rig.depth_unit_m);
}

TEST(Defaults, SayTheirSizeAndPutCamerasTogether) {
  EXPECT_EQ(defaultConfig().struct_size, sizeof(sphc_localizer_config));
  EXPECT_EQ(defaultAlignerConfig().struct_size, sizeof(sphc_aligner_config));
  EXPECT_EQ(emptyCamera().struct_size, sizeof(sphc_localizer_camera));
  EXPECT_EQ(emptyCamera().color_from_camera.q_wxyz[0], 1);
  EXPECT_EQ(emptyDepthCamera().struct_size, sizeof(sphc_localizer_depth_camera));
}

}  // namespace
}  // namespace sphc
