#include "runtime/localizer/tracker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "runtime/stages/pose/confidence.h"
#include "tests/support/arena_memory.h"
#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

constexpr int64_t kFrame = 33000000, kSecond = 1000000000;

constexpr double kSure = 0.99;  // a confidence

Rigid poseAt(double x_m, double turn_rad = 0) {
  return {rotationFromVector(Vector3(0, turn_rad, 0)), Vector3(x_m, 0, 0)};
}

Estimate found(const Rigid &camera_from_map) {
  Estimate estimate;
  estimate.camera_from_map = camera_from_map;
  estimate.inliers = 200;
  estimate.covariance = 1e-6 * Matrix6::Identity();  // 1 mrad, 1 mm
  return estimate;
}

class TrackerTest : public testing::Test {
 protected:
  Jump bring(int64_t time_ns, const Rigid &camera_from_map, uint32_t map = 0, const Odometry *odometry = nullptr,
             double confidence = kSure) {
    tracker_.advance(time_ns, odometry);
    trail_.add(time_ns, camera_from_map, found(camera_from_map).covariance);
    return tracker_.accept(map, found(camera_from_map), confidence);
  }
  TrackingState bringVague(int64_t time_ns, const Rigid &camera_from_map) {
    bring(time_ns, camera_from_map, 0, nullptr, 0.949);
    return tracker_.state();
  }
  void bringNone(int64_t time_ns) {
    tracker_.advance(time_ns, nullptr);
    tracker_.miss();
  }
  void track() {
    for (int i = 1; i <= 3; ++i) bring(i * kFrame, poseAt(0.01 * i));
    ASSERT_EQ(tracker_.state(), TrackingState::kTracking);
  }
  Tracker tracker_;
  Trail trail_;
};

TEST_F(TrackerTest, APoseIsTrustedOnceAnotherAgrees) {
  EXPECT_EQ(tracker_.state(), TrackingState::kRelocalizing);
  bring(kFrame, poseAt(0));
  EXPECT_EQ(tracker_.state(), TrackingState::kRelocalizing);
  bring(2 * kFrame, poseAt(2));  // not the same
  EXPECT_EQ(tracker_.state(), TrackingState::kRelocalizing);
  bring(3 * kFrame, poseAt(2.01));
  EXPECT_EQ(tracker_.state(), TrackingState::kTracking);
}

TEST_F(TrackerTest, ATrackIsTrustedFromASurePoseOn) {
  for (int i = 1; i <= 20; ++i) EXPECT_EQ(bringVague(i * kFrame, poseAt(0)), TrackingState::kRelocalizing);
  bring(21 * kFrame, poseAt(0));
  EXPECT_EQ(tracker_.state(), TrackingState::kTracking);
  EXPECT_EQ(bringVague(22 * kFrame, poseAt(0)), TrackingState::kTracking);
  bringNone(23 * kFrame);
  EXPECT_EQ(tracker_.state(), TrackingState::kLost);
  EXPECT_EQ(bringVague(24 * kFrame, poseAt(0)), TrackingState::kTracking);
}

// After half a second without odometry nearly every pose of a room is one that agrees.
TEST_F(TrackerTest, ATrackThatWasLostForLongNeedsASurePoseAgain) {
  track();
  const int64_t third = 3 * kFrame + kSecond / 3, half = 3 * kFrame + kSecond / 2;
  const Tracker tracked = tracker_;
  EXPECT_EQ(bringVague(third, poseAt(0.1)), TrackingState::kTracking);
  tracker_ = tracked;
  bringNone(half - kFrame);
  EXPECT_FALSE(tracker_.isSure());
  EXPECT_EQ(bringVague(half, poseAt(0.1)), TrackingState::kLost);
  EXPECT_EQ(bringVague(half + kFrame, poseAt(0.1)), TrackingState::kLost);
  bring(half + 2 * kFrame, poseAt(0.1));
  EXPECT_EQ(tracker_.state(), TrackingState::kTracking);
}

TEST_F(TrackerTest, TheSurePoseMayBeTheFirst) {
  bring(kFrame, poseAt(0));
  EXPECT_EQ(bringVague(2 * kFrame, poseAt(0)), TrackingState::kTracking);
}

TEST_F(TrackerTest, AVagueJumpIsANewTrack) {
  track();
  EXPECT_EQ(bringVague(4 * kFrame, poseAt(5)), TrackingState::kLost);
  EXPECT_EQ(bringVague(5 * kFrame, poseAt(5)), TrackingState::kLost);  // they agree, and none is sure
  int64_t time_ns = 5 * kFrame;
  while (time_ns - 3 * kFrame <= kSecond) bringVague(time_ns += kFrame, poseAt(5));
  EXPECT_EQ(tracker_.state(), TrackingState::kRelocalizing);
  bring(time_ns + kFrame, poseAt(5));
  EXPECT_EQ(tracker_.state(), TrackingState::kTracking);
}

TEST_F(TrackerTest, APoseThatAFaultDoubtsIsNotTracked) {
  track();
  tracker_.advance(4 * kFrame, nullptr);
  tracker_.accept(0, found(poseAt(0.04)), kSure, true);
  EXPECT_EQ(tracker_.state(), TrackingState::kLost);
  EXPECT_EQ(bringVague(5 * kFrame, poseAt(0.05)), TrackingState::kTracking);  // the track goes on
  int64_t time_ns = 5 * kFrame;
  while (time_ns - 5 * kFrame <= kSecond) {
    tracker_.advance(time_ns += kFrame, nullptr);
    tracker_.accept(0, found(poseAt(0.05)), kSure, true);
    EXPECT_NE(tracker_.state(), TrackingState::kTracking);
  }
  EXPECT_EQ(tracker_.state(), TrackingState::kRelocalizing);
}

// Only the state says how sure a track is: where the camera is expected does not depend on it.
TEST_F(TrackerTest, AVagueTrackIsExpectedLikeAnyOther) {
  Tracker sure = tracker_, vague = tracker_;
  for (int i = 1; i <= 3; ++i) {
    for (Tracker *tracker : {&sure, &vague}) {
      tracker->advance(i * kFrame, nullptr);
      tracker->accept(0, found(poseAt(0.01 * i)), tracker == &sure ? kSure : 0.3);
    }
  }
  Prediction of_sure, of_vague;
  for (Tracker *tracker : {&sure, &vague}) tracker->advance(4 * kFrame, nullptr);
  ASSERT_TRUE(sure.predict(&of_sure) && vague.predict(&of_vague));
  EXPECT_EQ(of_vague.camera_from_map.translation_m, of_sure.camera_from_map.translation_m);
  EXPECT_EQ(of_vague.translation_sigma_m, of_sure.translation_sigma_m);
  EXPECT_TRUE(vague.vetoes(0, found(poseAt(3))) == sure.vetoes(0, found(poseAt(3))));
}

TEST_F(TrackerTest, APoseInAnotherMapDoesNotAgree) {
  bring(kFrame, poseAt(0), 0);
  bring(2 * kFrame, poseAt(0), 1);
  EXPECT_EQ(tracker_.state(), TrackingState::kRelocalizing);
  bring(3 * kFrame, poseAt(0), 1);
  EXPECT_EQ(tracker_.state(), TrackingState::kTracking);
}

TEST_F(TrackerTest, FewInliersExpectLess) {
  const auto sigmaAfter = [this](uint32_t inliers) {
    Estimate estimate = found(poseAt(0));
    estimate.covariance *= 400;  // 2 cm
    estimate.inliers = inliers;
    tracker_.reset();
    tracker_.advance(kFrame, nullptr);
    tracker_.accept(0, estimate, kSure);
    tracker_.advance(kFrame + kFrame / 100, nullptr);
    Prediction expected;
    EXPECT_TRUE(tracker_.predict(&expected));
    return expected.translation_sigma_m;
  };
  EXPECT_GT(sigmaAfter(15), 2 * sigmaAfter(200));
}

TEST_F(TrackerTest, TimesMayLieAnywhere) {
  constexpr int64_t kFirst = std::numeric_limits<int64_t>::min(), kLast = std::numeric_limits<int64_t>::max();
  Prediction expected;
  for (int64_t time_ns : {kFirst, kLast, int64_t{0}, kLast, kFirst, kFirst + kFrame}) {
    bring(time_ns, poseAt(0));
    EXPECT_EQ(tracker_.state(),
              time_ns == kFirst + kFrame ? TrackingState::kTracking : TrackingState::kRelocalizing);
  }
}

// A centimetre a frame, by poses and by odometry where there is any; then a pose beside it.
class VetoTest : public TrackerTest {
 protected:
  void walk(int frames, uint32_t inliers = 100) {
    for (int i = 0; i < frames; ++i) {
      go();
      tracker_.accept(0, poseHere(0, inliers), kSure);
    }
    go();
  }
  void wander(int frames) {
    for (int i = 0; i < frames; ++i) {
      tracker_.miss();
      go();
    }
  }
  void go() {
    ++frame_;
    const Odometry odometry = {odometry_from_map_ * poseAt(-0.01 * frame_), 1e-4, 1e-3, scale_sigma_};
    tracker_.advance(frame_ * kFrame, has_odometry_ ? &odometry : nullptr);
  }
  Estimate poseHere(double off_m, uint32_t inliers, double turn_rad = 0) const {
    Estimate estimate = found(poseAt(0.01 * frame_ + off_m, turn_rad));
    estimate.inliers = inliers;
    return estimate;
  }
  bool vetoes(double off_m, uint32_t inliers, double turn_rad = 0) const {
    return tracker_.vetoes(0, poseHere(off_m, inliers, turn_rad));
  }
  static constexpr int kSecondOfFrames = 30;
  bool has_odometry_ = true;
  double scale_sigma_ = 0;
  Rigid odometry_from_map_;
  int frame_ = 0;
};

TEST_F(VetoTest, AJumpNeedsTwiceTheInliersOfTheTrack) {
  walk(4);
  EXPECT_TRUE(vetoes(1, 190));
  EXPECT_TRUE(vetoes(0, 190, 0.3)) << "turned";
  EXPECT_FALSE(vetoes(1, 200));
  EXPECT_FALSE(vetoes(0.1, 60)) << "no jump";
  EXPECT_FALSE(tracker_.vetoes(1, poseHere(1, 60))) << "another map";
}

TEST_F(VetoTest, ShiftsOfAnUnknownScaleDoNotCount) {
  walk(4);
  wander(kSecondOfFrames / 2);
  EXPECT_TRUE(vetoes(0.5, 120));
  scale_sigma_ = 1;
  walk(4);
  EXPECT_FALSE(tracker_.knowsShifts());
  wander(kSecondOfFrames / 2);
  EXPECT_FALSE(vetoes(0.5, 120));
  EXPECT_TRUE(vetoes(0, 120, 0.5)) << "turns do";
}

TEST_F(VetoTest, ThePoseThatMostSpeaksForCountsNotTheLast) {
  walk(4);
  walk(4, 20);
  EXPECT_TRUE(vetoes(1, 150));
}

TEST_F(VetoTest, PosesThatAreDrawnAwayStepByStepAreNoTrack) {
  walk(4);
  for (int step = 1; step <= 7; ++step) {
    tracker_.accept(0, poseHere(0.02 * step, 20), kSure);
    ASSERT_EQ(tracker_.state(), TrackingState::kTracking) << step;
    go();
  }
  EXPECT_FALSE(vetoes(0.14, 20));
  EXPECT_TRUE(vetoes(0.20, 20)) << "6 cm from the last, and 20 cm from the best";
}

TEST_F(VetoTest, WithOdometryItFadesInTenSeconds) {
  walk(4);
  wander(5 * kSecondOfFrames);
  EXPECT_TRUE(vetoes(1, 90)) << "half of twice as many";
  EXPECT_FALSE(vetoes(1, 110)) << "what was tracked may have been wrong";
  wander(5 * kSecondOfFrames);
  EXPECT_FALSE(vetoes(3, 10));
}

TEST_F(VetoTest, WithoutOdometryAHeadMovesSoFarAtMost) {
  has_odometry_ = false;
  walk(4);
  EXPECT_TRUE(vetoes(0.4, 60));
  EXPECT_TRUE(vetoes(0, 60, 0.5));
  wander(kSecondOfFrames / 5);
  EXPECT_FALSE(vetoes(0.4, 60));
  EXPECT_FALSE(vetoes(0, 60, 0.5));
  EXPECT_TRUE(vetoes(2, 60));
  EXPECT_TRUE(vetoes(0, 60, 3));
  wander(kSecondOfFrames);
  EXPECT_FALSE(vetoes(2, 60));
}

TEST_F(VetoTest, APoseThatWasNotTrackedVetoesNothing) {
  walk(1);
  EXPECT_FALSE(vetoes(1, 60)) << "one pose alone";
  walk(3);
  tracker_.accept(0, poseHere(1, 200), kSure);
  go();
  EXPECT_FALSE(vetoes(0, 60)) << "it jumped, so nothing is known";
}

TEST_F(VetoTest, AfterAResetNothingIsVetoed) {
  walk(4);
  ASSERT_TRUE(vetoes(1, 60));
  tracker_.reset();
  go();
  EXPECT_FALSE(vetoes(1, 60));
}

// Of images that nothing brings together the pose may be off by what the camera did meanwhile.
TEST_F(VetoTest, PosesOfImagesThatAreApartVetoLess) {
  for (int i = 0; i < 4; ++i) {
    go();
    tracker_.accept(0, poseHere(0, 100), kSure, false, 0.2);
  }
  go();
  EXPECT_FALSE(vetoes(0.5, 60));
  EXPECT_TRUE(vetoes(2, 60));
}

TEST_F(VetoTest, AMapThatIsGoneVetoesNothing) {
  walk(4);
  tracker_.forget(0);
  go();
  EXPECT_FALSE(vetoes(1, 60));
}

TEST_F(VetoTest, WithOdometryAPoseIsExpectedForTenSeconds) {
  walk(4);
  wander(9 * kSecondOfFrames);
  EXPECT_EQ(tracker_.state(), TrackingState::kRelocalizing) << "trust is of a second";
  Prediction expected;
  ASSERT_TRUE(tracker_.predict(&expected));
  EXPECT_NEAR(expected.camera_from_map.translation_m[0], 0.01 * frame_, 1e-9);
  EXPECT_GT(expected.translation_sigma_m, 0.016) << "270 steps of 1 mm";
  EXPECT_EQ(tracker_.accept(0, poseHere(0, 100), kSure).events, Events{0});
  EXPECT_EQ(tracker_.state(), TrackingState::kTracking) << "it is where it was expected";
  wander(11 * kSecondOfFrames);
  EXPECT_FALSE(tracker_.predict(&expected));
}

// As after a loop is closed there.
TEST_F(VetoTest, OdometryThatJumpsInItsOwnFrameSaysNothingOfThatStep) {
  for (const Rigid &jump : {poseAt(0.3), poseAt(0, 0.3)}) {
    walk(4);
    ASSERT_TRUE(vetoes(0.2, 100));
    odometry_from_map_ = jump * odometry_from_map_;
    go();
    EXPECT_FALSE(vetoes(0, 20)) << "the right pose";
    Prediction expected;
    ASSERT_TRUE(tracker_.predict(&expected));
    EXPECT_NEAR(expected.camera_from_map.translation_m[0], 0.01 * frame_, 1e-9) << "at the velocity of poses";
    EXPECT_EQ(tracker_.accept(0, poseHere(0, 100), kSure).events, Events{0});
    EXPECT_EQ(tracker_.state(), TrackingState::kTracking);
    go();
    EXPECT_TRUE(vetoes(0.2, 100)) << "and the next step counts again";
  }
}

TEST_F(VetoTest, OdometryThatBrokeCarriesNothing) {
  walk(4);
  wander(kSecondOfFrames / 2);
  has_odometry_ = false;
  wander(kSecondOfFrames);
  Prediction expected;
  EXPECT_FALSE(tracker_.predict(&expected));
}

TEST_F(TrackerTest, AMissLosesAndAnExpectedPoseFinds) {
  track();
  bringNone(4 * kFrame);
  EXPECT_EQ(tracker_.state(), TrackingState::kLost);
  bring(5 * kFrame, poseAt(0.05));
  EXPECT_EQ(tracker_.state(), TrackingState::kTracking);
}

TEST_F(TrackerTest, APoseElsewhereLosesUntilItIsConfirmed) {
  track();
  bring(4 * kFrame, poseAt(3));
  EXPECT_EQ(tracker_.state(), TrackingState::kLost);
  bring(5 * kFrame, poseAt(3.01));
  EXPECT_EQ(tracker_.state(), TrackingState::kTracking);
}

TEST_F(TrackerTest, LostForASecondIsForgotten) {
  track();
  Prediction expected;
  for (int i = 4; i * kFrame - 3 * kFrame <= kSecond; ++i) {
    bringNone(i * kFrame);
    EXPECT_EQ(tracker_.state(), TrackingState::kLost) << i;
    EXPECT_TRUE(tracker_.predict(&expected)) << i;
  }
  bringNone(3 * kFrame + kSecond + kFrame);
  EXPECT_EQ(tracker_.state(), TrackingState::kRelocalizing);
  EXPECT_FALSE(tracker_.predict(&expected));
}

TEST_F(TrackerTest, TimeThatDoesNotGrowOrJumpsStartsAnew) {
  for (const int64_t next : {3 * kFrame, kFrame, 3 * kFrame + kSecond + 1}) {
    tracker_.reset();
    track();
    tracker_.advance(next, nullptr);
    Prediction expected;
    EXPECT_EQ(tracker_.state(), TrackingState::kRelocalizing) << next;
    EXPECT_FALSE(tracker_.predict(&expected)) << next;
  }
}

TEST_F(TrackerTest, SteadyMotionIsPredicted) {
  const auto at = [](int i) { return poseAt(0.02 * i, 0.03 * i); };
  for (int i = 1; i <= 4; ++i) bring(i * kFrame, at(i));
  tracker_.advance(5 * kFrame, nullptr);
  Prediction expected;
  ASSERT_TRUE(tracker_.predict(&expected));
  const Rigid off = expected.camera_from_map * at(5).inverse();
  EXPECT_LT(rotationAngle(off.rotation), 1e-9);
  EXPECT_LT(off.translation_m.norm(), 0.002);  // a turning camera's step is not quite the same each time
  EXPECT_LT(expected.rotation_sigma_rad, 0.02);
  EXPECT_LT(expected.translation_sigma_m, 0.03);
}

// Over a bus that is busy, or with images left out.
TEST_F(TrackerTest, UnevenTimesOfSteadyMotionAreNoJumps) {
  Random random(3);
  for (const double short_s : {0.025, 0.005, 0.001}) {
    tracker_.reset();
    double time_s = 1;
    for (int i = 0; i < 200; ++i) {
      time_s += i % 2 ? short_s : 0.05 - short_s;
      const Rigid pose =
          poseAt(0.1 * time_s + 0.005 * test::normal(&random), 0.7 * time_s + 0.003 * test::normal(&random));
      const Jump jump = bring(static_cast<int64_t>(1e9 * time_s), pose);
      if (i < 2) continue;
      EXPECT_EQ(jump.events, Events{0}) << short_s << " " << i << " " << jump.shift_m << " " << jump.turn_rad;
      EXPECT_EQ(tracker_.state(), TrackingState::kTracking) << short_s << " " << i;
    }
  }
}

// After a short step nobody knows the velocity, but how fast a head is.
TEST_F(TrackerTest, AShortStepSaysLittleOfALongOne) {
  constexpr double kPoseM = 0.0051, kHeadM = 0.7 * 0.02;
  const auto sigmaAfter = [&](int64_t step_ns) {
    tracker_.reset();
    bring(kSecond - step_ns, poseAt(0));
    bring(kSecond, poseAt(0));
    tracker_.advance(kSecond + 20000000, nullptr);
    Prediction expected;
    EXPECT_TRUE(tracker_.predict(&expected));
    return expected.translation_sigma_m;
  };
  EXPECT_NEAR(sigmaAfter(20000000), kPoseM * std::sqrt(5.0), 3e-4);
  EXPECT_NEAR(sigmaAfter(16000000), kPoseM * std::hypot(2.25, 1.25), 3e-4);
  EXPECT_NEAR(sigmaAfter(5000000), std::hypot(kHeadM, kPoseM), 3e-4);
  EXPECT_NEAR(sigmaAfter(100000), std::hypot(kHeadM, kPoseM), 3e-4);
}

TEST_F(TrackerTest, PosesFarApartInTimeTellNoVelocity) {
  bring(kSecond, poseAt(0));
  bring(kSecond + 3 * kSecond / 10, poseAt(0.03));
  tracker_.advance(kSecond + 4 * kSecond / 10, nullptr);
  Prediction expected;
  ASSERT_TRUE(tracker_.predict(&expected));
  EXPECT_EQ(expected.camera_from_map.translation_m[0], 0.03);
}

TEST_F(TrackerTest, ATurnAloneIsAJump) {
  track();
  EXPECT_EQ(bring(4 * kFrame, poseAt(0.04, 0.5)).events, kJumped);
}

TEST_F(TrackerTest, WithoutVelocityLessIsKnown) {
  bring(kFrame, poseAt(0));
  tracker_.advance(2 * kFrame, nullptr);
  Prediction first, later;
  ASSERT_TRUE(tracker_.predict(&first));
  tracker_.miss();
  tracker_.advance(4 * kFrame, nullptr);
  ASSERT_TRUE(tracker_.predict(&later));
  EXPECT_GT(first.rotation_sigma_rad, 0.02);
  EXPECT_GT(later.rotation_sigma_rad, 2 * first.rotation_sigma_rad);
  EXPECT_GT(later.translation_sigma_m, 2 * first.translation_sigma_m);
}

TEST_F(TrackerTest, OdometryPredictsAnyMotionAndItsErrorsAddUp) {
  const auto odometryAt = [](int i) {  // in a frame of its own
    const Rigid odometry_from_map = {rotationFromVector(Vector3(0.3, 0.2, -1)), Vector3(5, 6, 7)};
    return Odometry{odometry_from_map * poseAt(0.01 * i * i, 0.1 * i).inverse(), 0.003, 0.004};
  };
  Odometry odometry = odometryAt(1);
  bring(kFrame, poseAt(0.01, 0.1), 0, &odometry);
  for (int i = 2; i <= 4; ++i) {
    odometry = odometryAt(i);
    tracker_.advance(i * kFrame, &odometry);
    tracker_.miss();
  }
  Prediction expected;
  ASSERT_TRUE(tracker_.predict(&expected));
  const Rigid off = expected.camera_from_map * poseAt(0.16, 0.4).inverse();
  EXPECT_LT(rotationAngle(off.rotation), 1e-9);
  EXPECT_LT(off.translation_m.norm(), 1e-9);
  EXPECT_GT(expected.rotation_sigma_rad, 0.003 * sqrtOf(3.0));
  EXPECT_LT(expected.rotation_sigma_rad, 0.008);
  EXPECT_GT(expected.translation_sigma_m, 0.004 * sqrtOf(3.0));

  tracker_.advance(5 * kFrame, nullptr);  // once it fails, only the motion limits are left
  Prediction without;
  ASSERT_TRUE(tracker_.predict(&without));
  EXPECT_GT(without.rotation_sigma_rad, 3 * expected.rotation_sigma_rad);
}

TEST_F(TrackerTest, APoseTellsHowFarItIsFromWhereItWasExpected) {
  const Jump first = bring(kFrame, poseAt(0));
  EXPECT_EQ(first.events, kRelocalized);
  EXPECT_EQ(first.shift_m, 0);
  for (int i = 2; i <= 4; ++i) {
    const Jump none = bring(i * kFrame, poseAt(0.01 * i));
    EXPECT_EQ(none.events, 0u);
    EXPECT_LT(none.shift_m, 0.021);
  }
  const Jump small = bring(5 * kFrame, poseAt(0.055, 0.004));  // 5 mm and 4 mrad beside
  EXPECT_EQ(small.events, 0u);
  EXPECT_NEAR(small.shift_m, 0.005, 2e-3);
  EXPECT_NEAR(small.turn_rad, 0.004, 1e-6);
  bring(6 * kFrame, poseAt(0.06)), bring(7 * kFrame, poseAt(0.07));
  const Jump large = bring(8 * kFrame, poseAt(1.08, 0.5));
  EXPECT_EQ(large.events, kJumped);
  EXPECT_NEAR(large.turn_rad, 0.5, 0.02);
  EXPECT_NEAR(large.shift_m, 1, 0.1);
  const Jump other = bring(9 * kFrame, poseAt(1.08, 0.5), 1);
  EXPECT_EQ(other.events, kMapChanged);
  EXPECT_EQ(other.shift_m, 0);
  EXPECT_EQ(other.turn_rad, 0);
  EXPECT_EQ(bring(10 * kFrame + kSecond, poseAt(1.08, 0.5), 1).events, kRelocalized);
}

// Two maps, the second 4 m beside and turned; both transforms with an error.
class HandoverTest : public TrackerTest {
 protected:
  HandoverTest() : memory_([this](Arena &arena, bool real) { MapSet::layout(2, arena, real ? &maps_ : nullptr); }) {
    maps_.set(7, MapView()), maps_.set(8, MapView());
    maps_.place(0, {true, Rigid(), 0, 0});
    maps_.place(1, {true, second_, 0.01, 0.02});
  }
  // In the second map.
  Rigid there(const Rigid &camera_from_first) const { return camera_from_first * second_; }
  Jump bringThere(int64_t time_ns, const Rigid &camera_from_first) {
    tracker_.advance(time_ns, nullptr);
    tracker_.goOver(1, maps_);
    return tracker_.accept(1, found(there(camera_from_first)), kSure);
  }
  Rigid second_ = {rotationFromVector(Vector3(0, 0.7, 0)), Vector3(4, 0, -1)};
  MapSet maps_;

 private:
  test::ArenaMemory memory_;
};

TEST_F(HandoverTest, WhatIsExpectedIsCarriedOver) {
  const Prediction expected = {0, poseAt(0.3, 0.2), 0.003, 0.005};
  Prediction over;
  ASSERT_TRUE(carriedOver(expected, 1, maps_, &over));
  EXPECT_EQ(over.map, 1u);
  EXPECT_LT((over.camera_from_map.translation_m - there(poseAt(0.3, 0.2)).translation_m).norm(), 1e-12);
  EXPECT_LT(rotationAngle(over.camera_from_map.rotation * there(poseAt(0.3, 0.2)).rotation.transpose()), 1e-7);
  EXPECT_NEAR(over.rotation_sigma_rad, std::hypot(0.003, 0.01), 1e-12);
  const double far_m = over.camera_from_map.translation_m.norm();
  EXPECT_NEAR(over.translation_sigma_m, std::hypot(0.005, 0.02, 0.01 * far_m), 1e-12);
  EXPECT_FALSE(carriedOver(over, 1, maps_, &over)) << "it is there";
  maps_.place(0, {});
  EXPECT_FALSE(carriedOver(expected, 1, maps_, &over));
}

TEST_F(HandoverTest, ThroughADoorTheCameraStaysTracked) {
  track();
  const Jump jump = bringThere(4 * kFrame, poseAt(0.06));
  EXPECT_EQ(jump.events, kMapChanged);
  EXPECT_NEAR(jump.shift_m, 0.02, 1e-9);
  EXPECT_EQ(tracker_.state(), TrackingState::kTracking);
  EXPECT_EQ(bringThere(5 * kFrame, poseAt(0.07)).events, 0u);
  EXPECT_EQ(tracker_.state(), TrackingState::kTracking);
}

TEST_F(HandoverTest, ATransformThatIsWrongShowsAsAJump) {
  track();
  const Jump jump = bringThere(4 * kFrame, poseAt(1.04));
  EXPECT_EQ(jump.events, kJumped | kMapChanged);
  EXPECT_NEAR(jump.shift_m, 1, 1e-9);
  EXPECT_EQ(tracker_.state(), TrackingState::kLost);
}

// The error of the transform is no velocity.
TEST_F(HandoverTest, NoRateIsLearntAcross) {
  track();
  bringThere(4 * kFrame, poseAt(0.08));  // 4 cm beside
  tracker_.advance(5 * kFrame, nullptr);
  Prediction expected;
  ASSERT_TRUE(tracker_.predict(&expected));
  EXPECT_LT((expected.camera_from_map.translation_m - there(poseAt(0.09)).translation_m).norm(), 1e-9);
  Motion motion;
  ASSERT_TRUE(tracker_.motion(trail_, &motion));
  EXPECT_EQ(motion.step.seconds, 0);
}

// The camera that turns and walks, one step a frame.
Rigid walked(double steps) {
  const Rigid map_from_camera = {rotationFromVector(Vector3(0, 0.03 * steps, 0)), Vector3(0.02 * steps, 0, 0)};
  return map_from_camera.inverse();
}

TEST_F(TrackerTest, MotionIsThatOfTheLastPoses) {
  Motion motion;
  EXPECT_FALSE(tracker_.motion(trail_, &motion)) << "no pose yet";
  bring(kFrame, walked(1));
  ASSERT_TRUE(tracker_.motion(trail_, &motion));
  EXPECT_EQ(motion.step.seconds, 0) << "no step yet";
  bring(2 * kFrame, walked(2)), bring(3 * kFrame, walked(3), 0);
  ASSERT_TRUE(tracker_.motion(trail_, &motion));
  EXPECT_EQ(motion.pose_time_ns, 3 * kFrame);
  EXPECT_EQ(motion.time_ns, 3 * kFrame);
  MovedPose moved;
  ASSERT_TRUE(moveTo(4 * kFrame, motion, &moved));
  EXPECT_LT(rotationAngle(moved.camera_from_map.rotation * walked(4).rotation.transpose()), 3e-4);
  EXPECT_LT((moved.camera_from_map.translation_m - walked(4).translation_m).norm(), 3e-4);
  bringNone(4 * kFrame);
  Motion later;
  ASSERT_TRUE(tracker_.motion(trail_, &later));
  EXPECT_EQ(later.time_ns, 3 * kFrame) << "the last pose's still";
  EXPECT_EQ(later.step.seconds, motion.step.seconds);
  for (int i = 5; i < 40; ++i) bringNone(i * kFrame);
  EXPECT_FALSE(tracker_.motion(trail_, &motion)) << "forgotten";
}

TEST_F(TrackerTest, MotionIsThatOfOdometryWhereThereIsOne) {
  const auto odometryAt = [](int i) {
    return Odometry{Rigid{rotationFromVector(Vector3(1, 0, 0)), Vector3(3, 4, 5)} * walked(i).inverse(), 1e-3,
                    2e-3};
  };
  const Rigid off = poseAt(0.3);  // what poses alone would tell is another motion
  Odometry odometry = odometryAt(1);
  bring(kFrame, walked(1), 0, &odometry);
  odometry = odometryAt(2);
  bring(2 * kFrame, off * walked(2), 0, &odometry);
  Motion at_pose, later;
  ASSERT_TRUE(tracker_.motion(trail_, &at_pose));
  EXPECT_EQ(at_pose.step.share_in_pose, 0) << "the pose is this frame's own";
  for (int i = 3; i <= 5; ++i) {
    odometry = odometryAt(i);
    tracker_.advance(i * kFrame, &odometry);
    tracker_.miss();
  }
  ASSERT_TRUE(tracker_.motion(trail_, &later));
  EXPECT_EQ(later.pose_time_ns, 2 * kFrame);
  EXPECT_EQ(later.time_ns, 5 * kFrame);
  EXPECT_EQ(later.step.share_in_pose, 1);
  EXPECT_NEAR(later.covariance(3, 3) - at_pose.covariance(3, 3), 3 * 4e-6, 1e-6);
  MovedPose moved;
  ASSERT_TRUE(moveTo(6 * kFrame, later, &moved));
  const Rigid expected = walked(6) * (walked(2).inverse() * off * walked(2));
  EXPECT_LT(rotationAngle(moved.camera_from_map.rotation * expected.rotation.transpose()), 1e-8);
  EXPECT_LT((moved.camera_from_map.translation_m - expected.translation_m).norm(), 1e-3);
}

TEST_F(TrackerTest, AScaleOfOdometryThatIsUnsureIsInTheStep) {
  Odometry odometry = {poseAt(0), 1e-3, 2e-3};
  bring(kFrame, poseAt(0), 0, &odometry);
  odometry = {poseAt(0.03), 1e-3, 2e-3};
  odometry.scale_sigma = 0.1;
  bring(2 * kFrame, poseAt(-0.03), 0, &odometry);
  Motion motion;
  ASSERT_TRUE(tracker_.motion(trail_, &motion));
  EXPECT_NEAR(axisSigma(motion.step.covariance, 3), std::hypot(2e-3, 0.1 * 0.03), 1e-9);
}

TEST_F(TrackerTest, MotionBesideAFrameIsThatOfTheStep) {
  const auto steady = [](double steps) {  // of the camera, in the frame of the odometry
    return Rigid{rotationFromVector(Vector3(0, 0.1 * steps, 0)), Vector3(0.03 * steps, 0, 0.1)};
  };
  Odometry odometry = {steady(0), 0.003, 0.004};
  Way way;
  tracker_.advance(kFrame, &odometry);
  EXPECT_FALSE(tracker_.waySince(kFrame, &way)) << "no step yet";
  odometry.odometry_from_camera = steady(1);
  tracker_.advance(2 * kFrame, &odometry);
  for (const double then : {0.5, 0.9, 1.0, 1.2}) {
    const int64_t then_ns = kFrame + static_cast<int64_t>(then * kFrame);
    ASSERT_TRUE(tracker_.waySince(then_ns, &way)) << then;
    const Rigid off = way.now_from_then * (steady(1).inverse() * steady(then)).inverse();
    EXPECT_LT(rotationAngle(off.rotation), 1e-7) << then;
    EXPECT_LT(off.translation_m.norm(), 1e-7) << then;
  }
  EXPECT_FALSE(tracker_.waySince(2 * kFrame - 200000000, &way)) << "too long ago";
  tracker_.advance(3 * kFrame, nullptr);
  EXPECT_FALSE(tracker_.waySince(3 * kFrame, &way)) << "no odometry";
}

TEST_F(TrackerTest, TheRateIsThatOfTheStep) {
  const double step_s = 1e-9 * kFrame;
  CameraRate rate;
  for (const int64_t begin_ns : {int64_t{0}, -10 * int64_t{kFrame}}) {
    tracker_.reset();
    Odometry odometry = {Rigid(), 0.003, 0.004};
    tracker_.advance(begin_ns, &odometry);
    EXPECT_FALSE(tracker_.rate(&rate)) << "no step yet";
    odometry.odometry_from_camera = {rotationFromVector(Vector3(0, 0.02, 0)), Vector3(0.01, 0, 0)};
    tracker_.advance(begin_ns + kFrame, &odometry);
    ASSERT_TRUE(tracker_.rate(&rate));
    // What stands still goes the other way.
    EXPECT_LT((rate.turn_rad_s - Vector3(0, -0.02, 0) / step_s).norm(), 0.001);
    EXPECT_LT((rate.shift_m_s - Vector3(-0.01, 0, 0) / step_s).norm(), 0.01);
    EXPECT_NEAR(rate.turn_sigma_rad_s, std::hypot(0.003 / step_s, 0.5 * tuning::kTurnAcceleration * step_s), 1e-9);
    EXPECT_NEAR(rate.shift_sigma_m_s, std::hypot(0.004 / step_s, 0.5 * tuning::kAcceleration * step_s), 1e-9);
    odometry.odometry_from_camera.translation_m.y() = 0.02;
    tracker_.advance(begin_ns + 2 * kFrame, &odometry);
    ASSERT_TRUE(tracker_.rate(&rate));
    EXPECT_LT(rate.turn_rad_s.norm(), 1e-6);
    EXPECT_LT((rate.shift_m_s - Vector3(0, -0.02, 0) / step_s).norm(), 1e-6);
    tracker_.advance(begin_ns + 3 * kFrame, nullptr);
    EXPECT_FALSE(tracker_.rate(&rate)) << "no odometry";
  }
}

TEST_F(TrackerTest, AVagueRateIsLessThanWasMeasured) {
  const Vector3 turn(0, 0.5, 0), shift(0.2, 0, 0.1);
  const CameraRate any, exact = ofAHead({turn, shift, 0.001, 0.001}), vague = ofAHead({turn, shift, 1, 0.7}),
                        unknown = ofAHead({turn, shift, 1e6, 1e6});
  EXPECT_LT((exact.turn_rad_s - turn).norm() + (exact.shift_m_s - shift).norm(), 1e-4);
  EXPECT_NEAR(exact.turn_sigma_rad_s, 0.001, 1e-6);
  EXPECT_LT((vague.turn_rad_s - 0.5 * turn).norm() + (vague.shift_m_s - 0.5 * shift).norm(), 1e-9);
  EXPECT_LT(vague.turn_sigma_rad_s, any.turn_sigma_rad_s);
  EXPECT_LT(unknown.turn_rad_s.norm() + unknown.shift_m_s.norm(), 1e-6);
  EXPECT_NEAR(unknown.turn_sigma_rad_s, any.turn_sigma_rad_s, 1e-6);
  EXPECT_NEAR(unknown.shift_sigma_m_s, any.shift_sigma_m_s, 1e-6);
}

}  // namespace
}  // namespace sphc
