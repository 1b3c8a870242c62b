#include "host/mapping/calibration_fit.h"

#include <gtest/gtest.h>

#include "made_up_walk.h"
#include "spotted_images.h"

namespace sphc::host {
namespace {

// Frames from `first` on show nothing.
Walk withoutKeypoints(Walk walk, size_t first = 0) {
  for (size_t i = first; i < walk.keyframes.size(); ++i) {
    walk.keyframes[i].points.clear();
    walk.keyframes[i].descriptors.clear();
  }
  return walk;
}

// A follower for a frame that has a place and for one that has none; frames that show nothing take no part.
TEST(CalibrationFitTest, FramesThatFoundAPlaceAreThoseThatItIsFoundBy) {
  Walk walk = withoutKeypoints(makeWalk({12, 0.3, 1}).walk, 8);
  walk.followers = {{0, 100, 3, {}}, {0, 101, 9, {}}};
  const auto read = [&](const TrialCalibration &) -> const Walk & { return walk; };
  EXPECT_EQ(fitCalibration(spottedRig(), read, {}, {}).frames, 9u);
}

TEST(CalibrationFitTest, TheGivenCalibrationStaysWhereNothingAgreesWithAnother) {
  const Walk sound = makeWalk({12, 0.3, 1}).walk;
  const Walk torn = withoutKeypoints(sound);
  int reads = 0;
  const auto read = [&](const TrialCalibration &) -> const Walk & { return reads++ == 0 ? sound : torn; };
  const CalibrationFit fit = fitCalibration(spottedRig(), read, {}, {});
  EXPECT_EQ(reads, 2);
  EXPECT_EQ(fit.rounds, 0);
  EXPECT_EQ(fit.frames, 12u);
  EXPECT_EQ(fit.calibration.color_camera.params[0], kSpottedFocalPx);
}

TEST(CalibrationFitTest, AWalkThatDoesNotAgreeWithTheGivenCalibrationIsRefused) {
  const Walk torn = withoutKeypoints(makeWalk({12, 0.3, 1}).walk);
  const auto read = [&](const TrialCalibration &) -> const Walk & { return torn; };
  EXPECT_THROW(fitCalibration(spottedRig(), read, {}, {}), NothingAgrees);
}

}  // namespace
}  // namespace sphc::host
