#include "runtime/localizer/pose_finder.h"

#include <gtest/gtest.h>

#include "tests/support/stepping_clock.h"
#include "tests/unit/runtime/localizer/room_parts.h"
#include "tests/unit/runtime/localizer/room_points.h"

namespace sphc {
namespace {

using tuning::kSamePose;

// A frame after one that was found where the upper half of it was seen from.
class TrackToConfirmTest : public testing::Test {
 protected:
  static constexpr uint32_t kUpper = 3, kLower = 0;

  TrackToConfirmTest()
      : parts_(test::mapOf(test::mostPointsOfTheRoom(), Vector3(0, 0, 1))),
        memory_([this](Arena &arena, bool real) {
          PoseFinder::layout(clocked(), arena, arena, real ? &finder_ : nullptr);
        }) {
    finder_.init(clocked());
    finder_.maps().set(0, parts_.search.maps().view(0));
    Estimate before;
    before.camera_from_map = parts_.cameraFromMap(kUpper);
    before.inliers = 200;
    before.covariance = 1e-6 * Matrix6::Identity();
    tracker_.advance(1, nullptr);
    tracker_.accept(0, before, 0.6);
    tracker_.advance(33000000, nullptr);
  }
  // The frame shows what kUpper sees, and below what `lower` sees.
  void find(uint32_t lower) {
    parts_.seeHalves(kUpper, lower);
    finder_.begin({&parts_.front, &parts_.fusion, &tracker_, parts_.config.depth_prior, false});
    finder_.find(Known(), Deadline(), &work_);
    ASSERT_TRUE(best().isLocalized());
    ASSERT_TRUE(best().guided);
    ASSERT_TRUE(isAtUpper());
  }
  const Hypothesis &best() const { return finder_.best(); }
  bool isAtUpper() const {
    return areNear(best().estimate.camera_from_map, parts_.cameraFromMap(kUpper), kSamePose);
  }
  // Looks at the clock until the deadline; so many of them are all that a search takes.
  void confirmWithin(uint32_t looks) {
    work_ = {};
    finder_.confirm(clock_.deadline(clock_.now_ns + clock_.step_ns * looks), &work_);
  }
  static constexpr uint32_t kAllLooks = 2000;

  test::RoomParts parts_;
  PoseFinder finder_;
  Tracker tracker_;
  Work work_;

 private:
  LocalizerConfig clocked() {
    LocalizerConfig config = parts_.config;
    config.clock = clock_.clock();
    return config;
  }
  test::SteppingClock clock_{1000};
  test::ArenaMemory memory_;
};

TEST_F(TrackToConfirmTest, APoseThatTheWholeMapFindsTooStays) {
  find(kUpper);
  finder_.confirm(Deadline(), &work_);
  EXPECT_TRUE(best().isLocalized());
  EXPECT_FALSE(best().has_near_rival);
}

TEST_F(TrackToConfirmTest, OneOfTwoPlacesIsAmbiguous) {
  find(kLower);
  finder_.confirm(Deadline(), &work_);
  EXPECT_EQ(best().outcome, Outcome::kUncertain);
  EXPECT_TRUE(best().is_ambiguous);
}

TEST_F(TrackToConfirmTest, ADeadlineLeavesThePoseAndTheDoubt) {
  uint32_t confirmed = 0, left = 0;
  for (uint32_t looks = 1; looks < kAllLooks; looks += 1 + looks / 8) {
    find(kUpper);
    confirmWithin(looks);
    EXPECT_TRUE(best().isLocalized()) << looks;
    EXPECT_EQ(best().has_near_rival, (work_.cuts & kCutVerification) != 0) << looks;
    confirmed += !best().has_near_rival;
    left += best().has_near_rival;
    find(kLower);
    confirmWithin(looks);
    EXPECT_TRUE(!best().isLocalized() || best().has_near_rival) << looks;
  }
  EXPECT_GT(confirmed, 5u);
  EXPECT_GT(left, 5u);
}

}  // namespace
}  // namespace sphc
