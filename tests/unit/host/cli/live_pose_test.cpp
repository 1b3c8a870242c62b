#include "host/cli/live_pose.h"

#include <gtest/gtest.h>

#include <spherecloud/spherecloud.hpp>

namespace sphc::host {
namespace {

sphc_localizer_result resultIn(uint32_t map) {
  sphc_localizer_result result = spherecloud::emptyResult();
  result.outcome = SPHC_OUTCOME_LOCALIZED;
  result.map_id = map;
  result.camera_from_map = {{1, 0, 0, 0}, {-1, 2, -0.5}};
  result.confidence = 0.9;
  return result;
}

TEST(LivePose, OfSeveralMapsNamesTheOneItIsIn) {
  EXPECT_EQ(livePoseText(resultIn(1), {"kitchen.sphc", "hall.sphc"}),
            "+1.00 -2.00 +0.50 m in hall.sphc, confidence 0.90");
  EXPECT_EQ(livePoseText(resultIn(0), {"kitchen.sphc"}), "+1.00 -2.00 +0.50 m, confidence 0.90");
}

TEST(LivePose, WithoutAPoseNamesNoMap) {
  sphc_localizer_result lost = spherecloud::emptyResult();
  lost.outcome = SPHC_OUTCOME_FEW_MATCHES;
  EXPECT_EQ(livePoseText(lost, {"kitchen.sphc", "hall.sphc"}), "no pose");
  sphc_localizer_result faulty = resultIn(0);
  faulty.faults = SPHC_FAULT_DEPTH_FROZEN;
  EXPECT_EQ(livePoseText(faulty, {"kitchen.sphc", "hall.sphc"}).rfind("FAULT: ", 0), 0u);
}

}  // namespace
}  // namespace sphc::host
