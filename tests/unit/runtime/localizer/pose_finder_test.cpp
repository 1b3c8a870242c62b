#include "runtime/localizer/pose_finder.h"

#include <gtest/gtest.h>

#include "runtime/stages/pose/confidence.h"
#include "tests/unit/runtime/localizer/room_parts.h"
#include "tests/unit/runtime/localizer/room_points.h"

namespace sphc {
namespace {

using tuning::kSamePose;
using tuning::kSureOfTrack;

// A frame after one that was found where the upper half of it was seen from.
class TrackToConfirmTest : public testing::Test {
 protected:
  static constexpr uint32_t kUpper = 3, kLower = 0;
  static constexpr double kVague = 0.6, kSure = 0.99;

  TrackToConfirmTest()
      : parts_(test::mapOf(test::mostPointsOfTheRoom(), Vector3(0, 0, 1))),
        memory_([this](Arena &arena, bool real) {
          PoseFinder::layout(parts_.config, arena, arena, real ? &finder_ : nullptr);
        }) {
    finder_.init(parts_.config);
    finder_.maps().set(0, parts_.search.maps().view(0));
  }
  // After a pose of this confidence.  The frame shows what kUpper sees, and below what `lower` sees.
  const Hypothesis &find(double confidence, uint32_t lower) {
    Estimate before;
    before.camera_from_map = parts_.cameraFromMap(kUpper);
    before.inliers = 200;
    before.covariance = 1e-6 * Matrix6::Identity();
    tracker_.advance(1, nullptr);
    tracker_.accept(0, before, confidence);
    tracker_.advance(33000000, nullptr);
    parts_.seeHalves(kUpper, lower);
    finder_.begin({&parts_.front, &parts_.fusion, &tracker_, parts_.config.depth_prior, false});
    finder_.find(Known(), Deadline(), &work_);
    return finder_.best();
  }
  bool isAtUpper() const {
    return areNear(finder_.best().estimate.camera_from_map, parts_.cameraFromMap(kUpper), kSamePose);
  }

  test::RoomParts parts_;
  PoseFinder finder_;
  Tracker tracker_;
  Work work_;

 private:
  test::ArenaMemory memory_;
};

TEST_F(TrackToConfirmTest, ATrackThatIsSureLooksWhereTheCameraIsExpectedAlone) {
  const Hypothesis &found = find(kSure, kUpper);
  EXPECT_TRUE(found.isLocalized());
  EXPECT_TRUE(found.guided);
}

TEST_F(TrackToConfirmTest, APoseThatWouldMakeATrackSureIsFoundInTheWholeMapToo) {
  const Hypothesis &found = find(kVague, kUpper);
  EXPECT_TRUE(found.isLocalized());
  EXPECT_FALSE(found.guided);
  EXPECT_TRUE(isAtUpper());
}

TEST_F(TrackToConfirmTest, AFrameOfTwoPlacesMakesNoTrackSure) {
  EXPECT_TRUE(find(kSure, kLower).isLocalized());
  EXPECT_TRUE(isAtUpper());
  EXPECT_GT(confidenceOf(statedCovariance(finder_.best().estimate)), kSureOfTrack);
  tracker_.reset();
  const Hypothesis &found = find(kVague, kLower);
  EXPECT_EQ(found.outcome, Outcome::kUncertain);
  EXPECT_TRUE(found.is_ambiguous);
}

}  // namespace
}  // namespace sphc
