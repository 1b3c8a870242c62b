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
            "+1.00 -2.00 +0.50 m, confidence 0.90 in hall.sphc");
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

TEST(LiveLine, HasRatesLossesAndThePoseWithinTheUsualTerminal) {
  sphc_localizer_result result = resultIn(0);
  result.state = SPHC_STATE_RELOCALIZING;
  result.inliers = 228;
  const std::string line = liveLine(result, {"room.sphc"}, {30, 30, 28, 3, 22});
  EXPECT_EQ(
      line.substr(0, 79).rfind("relocalizing in 30+30 out 28 Hz lost 3 | +1.00 -2.00 +0.50 m, confidence 0.90", 0),
      0u)
      << line;
  EXPECT_EQ(line.substr(line.size() - 23), " | 228 inliers, 22.0 ms") << line;
}

// The cure is said at the end; here it would push numbers out.
TEST(LiveLine, WithoutAPoseNamesTheHint) {
  sphc_localizer_result result = spherecloud::emptyResult();
  result.outcome = SPHC_OUTCOME_FEW_MATCHES;
  result.hints = SPHC_HINT_TOO_DARK | SPHC_HINT_NOT_IN_MAP;
  const std::string line = liveLine(result, {"room.sphc"}, {30, 30, 0, 0, 22});
  EXPECT_NE(line.find("out 0 Hz lost 0 | no pose, too dark, not in the map | 0 inliers"), std::string::npos)
      << line;
}

}  // namespace
}  // namespace sphc::host
