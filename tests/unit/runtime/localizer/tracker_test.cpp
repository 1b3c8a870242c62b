#include "runtime/localizer/tracker.h"

#include <gtest/gtest.h>

#include <limits>

namespace sphc {
namespace {

constexpr int64_t kFrame = 33000000, kSecond = 1000000000;

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
  void bring(int64_t time_ns, const Rigid &camera_from_map, uint32_t map = 0, const Odometry *odometry = nullptr) {
    tracker_.advance(time_ns, odometry);
    tracker_.accept(map, found(camera_from_map));
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
    tracker_.accept(0, estimate);
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

// Ten centimetres a frame by odometry and by poses; then a pose a metre beside it.
class VetoTest : public TrackerTest {
 protected:
  void walk(int frames) {
    for (int i = 0; i < frames; ++i) {
      go();
      tracker_.accept(0, poseHere(0, 100));
    }
    go();
  }
  void go() {
    ++frame_;
    const Odometry odometry = {poseAt(-0.1 * frame_), 1e-3, 1e-3};
    tracker_.advance(frame_ * 3 * kFrame, &odometry);
  }
  Estimate poseHere(double off_m, uint32_t inliers) const {
    Estimate estimate = found(poseAt(0.1 * frame_ + off_m));
    estimate.inliers = inliers;
    return estimate;
  }
  bool vetoes(double off_m, uint32_t inliers) const { return tracker_.vetoes(0, poseHere(off_m, inliers)); }
  int frame_ = 0;
};

TEST_F(VetoTest, OdometryVetoesAJumpThatFewerInliersSpeakFor) {
  walk(4);
  EXPECT_TRUE(vetoes(1, 60));
  EXPECT_FALSE(vetoes(1, 100)) << "as many inliers as before";
  EXPECT_FALSE(vetoes(0.1, 60)) << "no jump";
  EXPECT_FALSE(tracker_.vetoes(1, poseHere(1, 60))) << "another map";
}

TEST_F(VetoTest, ForASecondAtMost) {
  walk(4);
  for (int misses = 0; misses < 10; ++misses) {
    EXPECT_TRUE(vetoes(1, 60)) << misses;
    tracker_.miss();
    go();
  }
  EXPECT_FALSE(vetoes(1, 60)) << "what was tracked may have been wrong";
}

TEST_F(VetoTest, NothingIsVetoedWithoutTrustOrOdometry) {
  walk(1);
  EXPECT_FALSE(vetoes(1, 60)) << "one pose alone is not trusted";
  walk(3);
  ++frame_;
  tracker_.advance(frame_ * 3 * kFrame, nullptr);
  EXPECT_FALSE(vetoes(1, 60));
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
    return Odometry{odometry_from_map * poseAt(0.1 * i * i, 0.2 * i).inverse(), 0.003, 0.004};
  };
  Odometry odometry = odometryAt(1);
  bring(kFrame, poseAt(0.1, 0.2), 0, &odometry);
  for (int i = 2; i <= 4; ++i) {
    odometry = odometryAt(i);
    tracker_.advance(i * kFrame, &odometry);
    tracker_.miss();
  }
  Prediction expected;
  ASSERT_TRUE(tracker_.predict(&expected));
  const Rigid off = expected.camera_from_map * poseAt(1.6, 0.8).inverse();
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

TEST_F(TrackerTest, MotionBesideAFrameIsThatOfTheStep) {
  const auto steady = [](double steps) {  // of the camera, in the frame of the odometry
    return Rigid{rotationFromVector(Vector3(0, 0.2 * steps, 0)), Vector3(0.3 * steps, 0, 0.1)};
  };
  Odometry odometry = {steady(0), 0.003, 0.004};
  Rigid now_from_then;
  tracker_.advance(kFrame, &odometry);
  EXPECT_FALSE(tracker_.motionSince(kFrame, &now_from_then)) << "no step yet";
  odometry.odometry_from_camera = steady(1);
  tracker_.advance(2 * kFrame, &odometry);
  for (const double then : {0.5, 0.9, 1.0, 1.2}) {
    const int64_t then_ns = kFrame + static_cast<int64_t>(then * kFrame);
    ASSERT_TRUE(tracker_.motionSince(then_ns, &now_from_then)) << then;
    const Rigid off = now_from_then * (steady(1).inverse() * steady(then)).inverse();
    EXPECT_LT(rotationAngle(off.rotation), 1e-7) << then;
    EXPECT_LT(off.translation_m.norm(), 1e-7) << then;
  }
  EXPECT_FALSE(tracker_.motionSince(2 * kFrame - 200000000, &now_from_then)) << "too long ago";
  tracker_.advance(3 * kFrame, nullptr);
  EXPECT_FALSE(tracker_.motionSince(3 * kFrame, &now_from_then)) << "no odometry";
}

}  // namespace
}  // namespace sphc
