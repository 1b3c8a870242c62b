#include "host/mapping/calibration_fit.h"

#include <gtest/gtest.h>

#include "made_up_walk.h"
#include "spotted_images.h"

namespace sphc::host {
namespace {

// A follower for a frame that has a place and for one that has none; frames that show nothing take no part.
TEST(CalibrationFitTest, FramesThatFoundAPlaceAreThoseThatItIsFoundBy) {
  Walk walk = makeWalk({12, 0.3, 1}).walk;
  for (size_t i = 8; i < 12; ++i) {
    walk.keyframes[i].points.clear();
    walk.keyframes[i].descriptors.clear();
  }
  walk.followers = {{0, 100, 3, {}}, {0, 101, 9, {}}};
  const auto read = [&](const TrialCalibration &) -> const Walk & { return walk; };
  EXPECT_EQ(fitCalibration(spottedRig(), read, {}, {}).frames, 9u);
}

}  // namespace
}  // namespace sphc::host
