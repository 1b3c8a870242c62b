#include "runtime/localizer/odometry_check.h"

#include <gtest/gtest.h>

#include "runtime/localizer/tuning.h"

namespace sphc {
namespace {

using namespace tuning;

constexpr int64_t kFrame = 33000000;

// A camera by poses and by odometry: it turns about its y axis.
class OdometryCheckTest : public testing::Test {
 protected:
  // Of each degree so many by odometry, and so many about another axis.
  bool turn(int frames, double degrees_a_frame, double degrees_by_odometry = 1, double degrees_beside = 0) {
    for (int i = 0; i < frames; ++i) {
      angle_ += degrees(degrees_a_frame);
      odometry_rad_[1] += degrees_by_odometry * degrees(degrees_a_frame);
      odometry_rad_[0] += degrees_beside * degrees(degrees_a_frame);
      see();
    }
    return check_.disagrees();
  }
  // And moves ahead; of each metre so many by odometry, and so many to the right.
  bool go(int frames, double metres_a_frame, double metres_by_odometry = 1, double metres_beside = 0) {
    for (int i = 0; i < frames; ++i) {
      centre_m_[2] += metres_a_frame;
      odometry_m_[2] += metres_by_odometry * metres_a_frame;
      odometry_m_[0] += metres_beside * metres_a_frame;
      see();
    }
    return check_.disagrees();
  }
  void see() {
    time_ns_ += kFrame;
    Hypothesis found;
    found.map = map_;
    found.outcome = is_found_ ? Outcome::kLocalized : Outcome::kFewMatches;
    wobble_rad_ = -wobble_rad_;
    found.estimate.camera_from_map =
        Rigid{rotationFromVector(Vector3(0, angle_ + wobble_rad_, 0)), centre_m_}.inverse();
    found.estimate.covariance = 1e-6 * Matrix6::Identity();
    found.estimate.covariance(1, 1) += wobble_rad_ * wobble_rad_;
    found.estimate.inliers = 200;
    Known known;
    known.has_odometry = has_odometry_;
    known.odometry = {{rotationFromVector(odometry_rad_), odometry_m_}, turn_sigma_rad_, shift_sigma_m_};
    check_.advance(time_ns_);
    check_.look(known, found);
  }
  OdometryCheck check_;
  double angle_ = 0, wobble_rad_ = 0;  // the latter: what each pose is off by, to and fro
  Vector3 centre_m_ = Vector3::Zero(), odometry_rad_ = Vector3::Zero(), odometry_m_ = Vector3::Zero();
  uint32_t map_ = 0;
  bool is_found_ = true, has_odometry_ = true;
  double turn_sigma_rad_ = 1e-4, shift_sigma_m_ = 1e-3;
  int64_t time_ns_ = 0;
};

TEST_F(OdometryCheckTest, SoundOdometryAgrees) {
  EXPECT_FALSE(turn(300, 2));
  EXPECT_FALSE(go(300, 0.02));
}

// A direction that is a degree off is half a metre after 30.
TEST_F(OdometryCheckTest, SoundOdometryAgreesWithVaguePosesOverALongWay) {
  wobble_rad_ = degrees(1);
  EXPECT_FALSE(go(600, 0.1));
}

TEST_F(OdometryCheckTest, TwiceAsFarApartAsAJumpIsEnough) {
  EXPECT_FALSE(turn(1 + 15, 1, 0)) << "15 degrees that odometry does not know";
  EXPECT_TRUE(turn(5, 1, 0));
}

TEST_F(OdometryCheckTest, TheInverseAndAnotherAxisAreTold) {
  EXPECT_TRUE(turn(20, 1, -1)) << "twice as far apart";
  check_.reset();
  EXPECT_FALSE(check_.disagrees());
  EXPECT_TRUE(turn(30, 1, 0, 1));
}

TEST_F(OdometryCheckTest, ShiftsThatNoScaleOfDepthExplainsAreTold) {
  EXPECT_TRUE(go(60, 0.02, 0)) << "none at all";
  check_.reset();
  EXPECT_TRUE(go(60, 0.02, -1)) << "backwards";
  check_.reset();
  EXPECT_TRUE(go(60, 0.02, 0, 1)) << "to the side";
  check_.reset();
  EXPECT_TRUE(go(60, 0.02, 10));
  for (const double scale : {0.4, 3.0}) {
    check_.reset();
    EXPECT_FALSE(go(60, 0.02, scale)) << scale;
  }
}

TEST_F(OdometryCheckTest, WhatIsStatedAsVagueMayBeOff) {
  turn_sigma_rad_ = degrees(2);
  EXPECT_FALSE(turn(60, 1, 0));
  shift_sigma_m_ = 0.05;
  EXPECT_FALSE(go(60, 0.02, 0));
}

TEST_F(OdometryCheckTest, JumpsOfPosesAndOfOdometryAreNone) {
  for (int jump = 0; jump < 6; ++jump) {
    angle_ += degrees(jump % 2 ? -40 : 40);
    EXPECT_FALSE(turn(5, 1)) << jump;
  }
  for (int jump = 0; jump < 6; ++jump) {
    odometry_rad_[0] += degrees(20);
    odometry_m_[0] += 1;
    EXPECT_FALSE(turn(5, 1)) << jump;
  }
}

TEST_F(OdometryCheckTest, JumpsAtEveryStepAreOfOdometry) {
  EXPECT_FALSE(turn(4, 12, -1)) << "the third in a row";
  EXPECT_TRUE(turn(1, 12, -1));
}

TEST_F(OdometryCheckTest, WhatIsNotSeenInARowIsNotCompared) {
  for (int i = 0; i < 40; ++i) {
    is_found_ = false;
    turn(9, 1, 0);  // a third of a second
    is_found_ = true;
    EXPECT_FALSE(turn(1, 1, 0));
  }
}

TEST_F(OdometryCheckTest, ItIsBelievedAgainAfterTenSecondsInWhichItAgrees) {
  ASSERT_TRUE(turn(30, 1, 0));
  EXPECT_TRUE(turn(290, 0.1));
  EXPECT_FALSE(turn(30, 0.1));
  EXPECT_TRUE(turn(10, 1, 0)) << "one contradiction more is enough";
  EXPECT_FALSE(turn(2 * 310, 0.1));
  EXPECT_FALSE(turn(14, 1, 0)) << "and none is left of those before";
}

TEST_F(OdometryCheckTest, AnotherMapAndATimeThatDoesNotGrowBeginAnew) {
  turn(14, 1, 0);
  map_ = 1;
  EXPECT_FALSE(turn(8, 1, 0)) << "one more contradiction of the first map, none of the second";
  ASSERT_TRUE(turn(20, 1, 0));
  check_.forget(0);
  EXPECT_TRUE(check_.disagrees());
  check_.forget(1);
  EXPECT_FALSE(check_.disagrees());
  ASSERT_TRUE(turn(40, 1, 0));
  time_ns_ -= 10 * kFrame;
  check_.advance(time_ns_);
  EXPECT_FALSE(check_.disagrees()) << "of the first frame of the new time on";
  EXPECT_FALSE(turn(1, 1, 0));
}

TEST_F(OdometryCheckTest, WithoutOdometryNothingDisagrees) {
  has_odometry_ = false;
  EXPECT_FALSE(turn(300, 1, 0));
}

}  // namespace
}  // namespace sphc
