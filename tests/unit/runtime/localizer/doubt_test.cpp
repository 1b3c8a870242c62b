#include "runtime/localizer/doubt.h"

#include <gtest/gtest.h>

#include "runtime/localizer/tuning.h"
#include "tests/unit/runtime/localizer/room_parts.h"

namespace sphc {
namespace {

using namespace tuning;

// A pose of the test room, from true matches.
class DoubtTest : public testing::Test {
 protected:
  DoubtTest() {
    parts_.see(0);
    found().begin(0);
    found().outcome = Outcome::kLocalized;
    parts_.search.matchEverywhere(parts_.askAll(), parts_.front.keypointCount(), {}, &found().matched,
                                  &parts_.work);
    PoseQuery query = this->query();
    query.correspondences = found().matched.all();
    found().estimate = parts_.estimator.refine(query, parts_.cameraFromMap(0));
  }
  PoseQuery query() const {
    PoseQuery query;
    query.prior = &nothing_;
    query.depth = parts_.config.depth_prior;
    return query;
  }
  // The vertical that the pose itself says, turned by so much.
  Known knownVertical(double off_rad) {
    Known known;
    known.prior.has_up = true;
    known.prior.up_map = Vector3::UnitZ();
    known.prior.up_camera = Eigen::AngleAxisd(off_rad, Vector3::UnitX()).toRotationMatrix() *
                            parts_.cameraFromMap(0).rotation * known.prior.up_map;
    known.prior.up_sigma_rad = 1e-3;
    return known;
  }
  Vertical compare(const Known &known, uint32_t min_inliers = 10) {
    return compareVertical(known, found(), query(), min_inliers, &parts_.estimator);
  }
  Hypothesis &found() { return parts_.found; }

  const PosePrior nothing_;
  test::RoomParts parts_;
};

TEST_F(DoubtTest, AVerticalThatIsOffByDegreesDisagrees) {
  EXPECT_EQ(compare(knownVertical(0)), Vertical::kAgrees);
  EXPECT_EQ(compare(knownVertical(degrees(0.5))), Vertical::kAgrees);
  EXPECT_EQ(compare(knownVertical(degrees(5))), Vertical::kDisagrees);
}

TEST_F(DoubtTest, APoseThatHoldsByTheVerticalAloneSaysNothingOfIt) {
  EXPECT_EQ(compare(knownVertical(degrees(5)), found().estimate.inliers + 1000), Vertical::kUnknown);
}

TEST_F(DoubtTest, WithoutAPoseOrAVerticalNothingDisagrees) {
  Known known = knownVertical(degrees(5));
  known.map = 1;
  EXPECT_EQ(compare(known), Vertical::kAgrees) << "the vertical of another map";
  known = knownVertical(degrees(5));
  known.prior.has_up = false;
  EXPECT_EQ(compare(known), Vertical::kAgrees);
  found().outcome = Outcome::kUncertain;
  EXPECT_EQ(compare(knownVertical(degrees(5))), Vertical::kUnknown);
}

// Walks along x by odometry.
class TravelCheckTest : public DoubtTest {
 protected:
  bool walk(uint32_t steps, double scale) {
    bool scaled = false;
    for (uint32_t i = 0; i < steps; ++i, ++step_) {
      Known known;
      known.has_odometry = true;
      known.odometry.translation_sigma_m = step_sigma_m_;
      known.odometry.odometry_from_camera.translation_m = {step_m_ * step_, 0, 0};
      tracker_.advance(int64_t{100000000} * step_, &known.odometry);
      found().estimate.camera_from_map = {Matrix3::Identity(), {-step_m_ * scale * step_, 0, 0}};
      scaled = check_.isScaled(known, tracker_, found());
    }
    return scaled;
  }
  Tracker tracker_;
  TravelCheck check_;
  uint32_t step_ = 1;
  double step_m_ = 0.1, step_sigma_m_ = 0;
};

TEST_F(TravelCheckTest, PosesThatGoFartherThanOdometryAreScaled) {
  EXPECT_FALSE(walk(30, 1));
  check_.reset();
  EXPECT_TRUE(walk(30, 1.3));
}

// The way is as long, and odometry drifts on it for ten times as many steps.
TEST_F(TravelCheckTest, FramesWithoutAPoseAddTheirSteps) {
  step_sigma_m_ = 0.02;
  EXPECT_TRUE(walk(30, 1.3));
  check_.reset();
  step_m_ = 0.01;
  for (int pose = 0; pose < 30; ++pose) {
    found().outcome = Outcome::kUncertain;
    walk(9, 1.3);
    found().outcome = Outcome::kLocalized;
    EXPECT_FALSE(walk(1, 1.3)) << pose;
  }
}

TEST_F(TravelCheckTest, AnotherMapBeginsAnotherWay) {
  EXPECT_TRUE(walk(30, 1.3));
  found().map = 1;
  EXPECT_FALSE(walk(1, 1.3));
}

TEST(Doubt, ABiasFarOutsideItsPriorIsBeyondIt) {
  DepthCalibration prior;
  prior.mean = Vector2::Zero();
  prior.covariance = Vector2(4e-4, 1e-4).asDiagonal();
  DepthCalibration learnt = prior;
  learnt.mean = {0.04, 0.02};  // 2 sigmas
  EXPECT_FALSE(isBeyondPrior(learnt, prior));
  for (const Vector2 &far : {Vector2(0, 0.03), Vector2(0.06, 0), Vector2(-0.06, 0)}) {
    learnt.mean = far;
    EXPECT_TRUE(isBeyondPrior(learnt, prior)) << far.transpose();
  }
  prior.covariance.setZero();
  EXPECT_FALSE(isBeyondPrior(learnt, prior)) << "of a sensor that is known nothing is learnt";
}

TEST(Doubt, LowersTheConfidenceAndNeverRaisesIt) {
  Hypothesis few, many, rivalled;
  few.estimate.inliers = 30;
  many.estimate.inliers = rivalled.estimate.inliers = kInliersBeyondDoubtfulEdges;
  rivalled.has_near_rival = true;
  Hypothesis scattered = many;
  scattered.has_doubtful_focal = true;
  EXPECT_EQ(doubted(0.99, scattered, 0, false), kMostConfidenceOfDoubt);
  EXPECT_EQ(doubted(0.99, few, 0, false), 0.99);
  EXPECT_EQ(doubted(0.99, few, kDepthConstant, false), 0.99);  // which takes the pose away
  EXPECT_EQ(doubted(0.99, many, kDepthScale, false), kMostConfidenceOfFaults);
  EXPECT_EQ(doubted(0.99, many, kDepthBias, false), kMostConfidenceOfFaults);
  EXPECT_EQ(doubted(0.99, few, 0, true), kMostConfidenceOfDoubt);
  EXPECT_EQ(doubted(0.99, many, 0, true), 0.99);
  EXPECT_EQ(doubted(0.99, many, kFocalDisagrees, false), kMostConfidenceOfDoubt);
  EXPECT_EQ(doubted(0.99, many, kFocalDisagrees | kDepthBias, false), kMostConfidenceOfFaults);
  EXPECT_EQ(doubted(0.99, rivalled, 0, false), kMostConfidenceOfNearRival);
  EXPECT_EQ(doubted(0.99, rivalled, kFocalDisagrees, false), kMostConfidenceOfDoubt);
  EXPECT_EQ(doubted(0.1, few, kDepthScale, true), 0.1);
  EXPECT_EQ(doubted(0.1, rivalled, 0, false), 0.1);
}

}  // namespace
}  // namespace sphc
