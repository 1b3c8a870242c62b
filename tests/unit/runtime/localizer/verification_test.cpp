#include "runtime/localizer/verification.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "runtime/localizer/tuning.h"
#include "runtime/stages/pose/mirrored.h"
#include "tests/support/pose_world.h"
#include "tests/support/random_numbers.h"
#include "tests/unit/runtime/localizer/room_parts.h"

namespace sphc {
namespace {

using namespace tuning;

class VerificationTest : public testing::Test {
 protected:
  explicit VerificationTest(std::vector<test::SceneMap> maps) : parts_(std::move(maps)) {}
  explicit VerificationTest(double eta = 0.5) : parts_(eta) {}

  PoseTask task() {
    PoseTask task;
    task.question = parts_.askAll();
    task.query.depth = parts_.config.depth_prior;
    task.query.seed = 1;
    task.solid_angle_sr = 4 * kPi;
    task.cones_rad = {kConesOfSearchedPose, 2};
    return task;
  }
  // Sees the room and matches the first keypoints everywhere.
  PoseTask seen(uint32_t viewpoint, uint32_t room = 0, uint32_t keypoints = UINT32_MAX) {
    parts_.see(viewpoint, room);
    const PoseTask task = this->task();
    found().begin(0);
    parts_.search.matchEverywhere(task.question, std::min(keypoints, parts_.front.keypointCount()), {},
                                  &found().matched, &parts_.work);
    return task;
  }
  void verify(const PoseTask &task) {
    Verification(&parts_.search, &parts_.estimator, &parts_.fusion, min_inliers_, &parts_.work)
        .findPose(task, &found(), &parts_.rival);
  }
  double errorM(uint32_t viewpoint) {
    return test::translationErrorM(found().estimate.camera_from_map, parts_.cameraFromMap(viewpoint));
  }
  Hypothesis &found() { return parts_.found; }

  uint32_t min_inliers_ = 10;
  test::RoomParts parts_;
};

TEST_F(VerificationTest, FindsWhereItsRoomIsSeenFrom) {
  for (uint32_t viewpoint : {0u, 1u, 3u}) {
    verify(seen(viewpoint));
    EXPECT_EQ(found().outcome, Outcome::kLocalized) << viewpoint;
    EXPECT_LT(errorM(viewpoint), 0.02) << viewpoint;
    EXPECT_EQ(found().evidence.source, MatchSource::kGlobal);
    EXPECT_LT(found().evidence.log_chance_first, kMostLogChance);
    EXPECT_LT(found().evidence.log_chance_second, 0);
    EXPECT_EQ(found().evidence.inliers, found().estimate.inliers);
  }
}

TEST_F(VerificationTest, AnotherRoomIsNotBelieved) {
  for (uint32_t room = 1; room <= 4; ++room) {
    verify(seen(0, room));
    EXPECT_FALSE(found().isLocalized()) << room;
  }
}

TEST_F(VerificationTest, GuidedRematchingAsksEveryKeypointNearThePose) {
  constexpr uint32_t kFirst = 80;
  verify(seen(1, 0, kFirst));
  ASSERT_TRUE(found().isLocalized());
  const auto matches = found().matched.matches();
  const auto is_new = [&](const Match &match) { return match.query >= kFirst; };
  EXPECT_GT(std::count_if(matches.begin(), matches.end(), is_new), 40);
  for (const Correspondence &c : found().matched.ofThisFrame())
    EXPECT_LT(parts_.angleOff(c, found().estimate.camera_from_map), kConesOfSearchedPose[1] + degrees(0.5));
}

TEST_F(VerificationTest, TooFewMatchesAreNotSearched) {
  const PoseTask task = seen(0);
  found().matched.assign(kFewestMatches - 1, parts_.front, parts_.search.map(0));
  verify(task);
  EXPECT_EQ(found().outcome, Outcome::kFewMatches);
  EXPECT_EQ(parts_.work.samples, 0u);
}

TEST_F(VerificationTest, CountsTheSamples) {
  verify(seen(0));
  EXPECT_GT(found().searched.iterations, 0u);
  EXPECT_GE(parts_.work.samples, found().searched.iterations);
}

TEST_F(VerificationTest, TheDeadlineIsTheReasonWhereItPassed) {
  PoseTask task = seen(0);
  task.query.deadline = Deadline::after({[](void *) { return int64_t{10}; }, nullptr}, 0, 1);
  verify(task);
  EXPECT_EQ(found().outcome, Outcome::kDeadline);
}

TEST_F(VerificationTest, FewerInliersThanTheConfigAsksForAreNotBelieved) {
  min_inliers_ = 5000;
  verify(seen(0));
  EXPECT_EQ(found().outcome, Outcome::kNoConsensus);
  EXPECT_LT(errorM(0), 0.02);
}

// In a narrow cone more agrees by chance.
TEST_F(VerificationTest, AgreementWhereThePoseWasExpectedProvesLess) {
  PoseTask task = seen(0);
  verify(task);
  const double everywhere = found().evidence.log_chance_first;
  task = seen(0);
  task.solid_angle_sr = solidAngleOf(degrees(5));
  found().guided = true;
  verify(task);
  EXPECT_EQ(found().evidence.source, MatchSource::kExpected);
  EXPECT_GT(found().evidence.log_chance_first, everywhere + 10);
}

TEST_F(VerificationTest, RaysTakePartInGuidedRematching) {
  PoseTask task = seen(0);
  const uint32_t lifted = parts_.front.liftedCount();
  ASSERT_LT(lifted, parts_.front.keypointCount()) << "the frame has no keypoint without depth";
  const Match rays[] = {{lifted, 5, 10, 40}};
  task.rays = {rays, 1};
  verify(task);
  const auto matches = found().matched.matches();
  ASSERT_FALSE(matches.empty());
  EXPECT_EQ(matches[matches.size() - 1].query, lifted);
  EXPECT_EQ(matches[matches.size() - 1].point_index, 5u);
}

// What earlier frames matched stands behind this frame's matches, after every guided re-matching, and proves
// nothing about it.
TEST_F(VerificationTest, EarlierFramesTakePartWhereTheyWerePutTogether) {
  Tracker tracker;
  const Odometry still = {{}, 1e-4, 1e-4};
  tracker.advance(1000, &still);
  seen(0);
  parts_.fusion.remember(0, found().matched);
  tracker.advance(1000 + 33000000, &still);
  parts_.fusion.advance(tracker);

  verify(seen(0, 0, 60));
  EXPECT_EQ(found().matched.all().size(), found().matched.matches().size());
  const double alone = found().evidence.log_chance_second;
  const PoseTask task = seen(0, 0, 60);
  found().begin(0, 2);
  parts_.search.matchEverywhere(task.question, 60, {}, &found().matched, &parts_.work);
  verify(task);
  EXPECT_EQ(found().frames, 2u);
  EXPECT_GT(found().matched.all().size(), found().matched.matches().size());
  EXPECT_NEAR(found().evidence.log_chance_second, alone, 0.1 * -alone);
}

TEST_F(VerificationTest, AmongManyInliersAFewHaveNoSay) {
  verify(seen(0));
  ASSERT_GT(found().estimate.inliers, kInliersBeyondChallenge);
  EXPECT_EQ(found().leverage.indices.size(), 0u);
  EXPECT_EQ(found().evidence.centre_sigma_ratio, 1);
}

// The points that the first viewpoints show, where they are in the room.
std::vector<test::WorldPoint> pointsOfTheRoom() {
  const sphc_config config = test::sceneConfig();
  test::ViewDescriber describer(config.rig.color_camera, config.max_keypoints);
  std::vector<test::WorldPoint> points;
  for (uint32_t view = 0; view < 3; ++view) {
    const Rigid camera_from_world = test::sceneViewpoint(view);
    const auto images =
        test::renderScene(config.rig.color_camera, config.rig.color_camera, camera_from_world, Rigid());
    describer.describe(images, camera_from_world, &points);
  }
  return points;
}

// Those within a radius of a place on the far wall, 3 m ahead.
std::vector<test::WorldPoint> pointsOfTheWall(double x_m, double radius_m) {
  std::vector<test::WorldPoint> kept;
  for (const test::WorldPoint &point : pointsOfTheRoom())
    if ((point.position_m - Vector3(x_m, 0, 3)).norm() < radius_m) kept.push_back(point);
  return kept;
}

// All of them real.
std::vector<test::SceneMap> mapOf(const std::vector<test::WorldPoint> &points, const Vector3 &centre_m) {
  return {{test::encodeMap(test::sphereCloud(points, centre_m, 1), kExtractorId), centre_m}};
}

// A round piece of the wall, seen obliquely from a sphere centre so far off.
class PlanarTest : public VerificationTest {
 protected:
  PlanarTest(double radius_m, double far_m)
      : VerificationTest(mapOf(pointsOfTheWall(0, radius_m), Vector3(0, 0, 3) + far_m * Vector3(0.56, 0, -0.83))) {}
};

class ClearPlanarTest : public PlanarTest {
 protected:
  ClearPlanarTest() : PlanarTest(1.1, 10) {}
};

class VaguePlanarTest : public PlanarTest {
 protected:
  VaguePlanarTest() : PlanarTest(0.8, 16) {}
};

// A search that was told of the mirrored pose ends there; what supports the other one better is seen all the same.
TEST_F(ClearPlanarTest, TheBetterOfTwoMirroredPosesIsFound) {
  for (uint32_t viewpoint = 0; viewpoint < 3; ++viewpoint) {
    PoseTask task = seen(viewpoint);
    PosePrior mirrored;
    mirrored.has_pose = true;
    mirrored.rotation_sigma_rad = 0.2;
    mirrored.translation_sigma_m = 1;
    ASSERT_TRUE(mirroredPose(found().matched.all(), parts_.cameraFromMap(viewpoint),
                             parts_.estimator.inlierThreshold2(), &mirrored.camera_from_map));
    task.query.prior = &mirrored;
    verify(task);
    EXPECT_GT(test::translationErrorM(found().searched.camera_from_map, parts_.cameraFromMap(viewpoint)), 1);
    EXPECT_LT(errorM(viewpoint), 0.01) << viewpoint;
    EXPECT_TRUE(found().isLocalized()) << viewpoint;
  }
}

TEST_F(VaguePlanarTest, NobodyCanTellTwoPosesThatAreNearlyAsGood) {
  for (uint32_t viewpoint = 0; viewpoint < 3; ++viewpoint) {
    verify(seen(viewpoint));
    EXPECT_EQ(judgePose(found().evidence, found().estimate, min_inliers_), Outcome::kLocalized) << viewpoint;
    EXPECT_EQ(found().outcome, Outcome::kUncertain) << viewpoint;
    EXPECT_TRUE(found().is_ambiguous) << viewpoint;
  }
}

// So few points that neither half of a frame is beyond doubt.
class ThinRoomTest : public VerificationTest {
 protected:
  ThinRoomTest() : VerificationTest(mapOf(thinned(), Vector3(0, 0, 1))) {}
  static std::vector<test::WorldPoint> thinned() {
    const std::vector<test::WorldPoint> all = pointsOfTheRoom();
    std::vector<test::WorldPoint> kept;
    for (size_t i = 0; i < all.size(); i += 5) kept.push_back(all[i]);
    return kept;
  }
  void verifyHalves(uint32_t upper, uint32_t lower) {
    parts_.seeHalves(upper, lower);
    const PoseTask task = this->task();
    found().begin(0);
    parts_.search.matchEverywhere(task.question, parts_.front.keypointCount(), {}, &found().matched, &parts_.work);
    verify(task);
  }
};

TEST_F(ThinRoomTest, APoseThatTheOtherKeypointsContradictIsAmbiguous) {
  verifyHalves(0, 0);
  EXPECT_TRUE(found().isLocalized());
  verifyHalves(0, 4);
  ASSERT_LT(found().estimate.inliers, kInliersBeyondOthers);
  EXPECT_EQ(judgePose(found().evidence, found().estimate, min_inliers_), Outcome::kLocalized);
  EXPECT_EQ(found().outcome, Outcome::kUncertain);
  EXPECT_TRUE(found().is_ambiguous);
  EXPECT_LT(std::min(errorM(0), errorM(4)), 0.02);
}

// A small patch, and far beside it one or two points more.
class FewFarPointsTest : public VerificationTest {
 protected:
  FewFarPointsTest() : VerificationTest(mapOf(joined(), Vector3(0, 0, 1))) {}
  static std::vector<test::WorldPoint> joined() {
    std::vector<test::WorldPoint> points = pointsOfTheWall(-0.3, 0.3);
    for (const test::WorldPoint &point : pointsOfTheWall(1.2, 0.1)) points.push_back(point);
    return points;
  }
};

TEST_F(FewFarPointsTest, APoseThatRestsOnThemIsAskedForAgainWithoutThem) {
  for (uint32_t viewpoint = 0; viewpoint < 3; ++viewpoint) {
    parts_.work = {};
    verify(seen(viewpoint));
    EXPECT_GT(found().leverage.centre_sigma_ratio, 2 * kRestsOnFew) << viewpoint;
    EXPECT_EQ(found().evidence.centre_sigma_ratio, found().leverage.centre_sigma_ratio);
    ASSERT_GT(found().leverage.indices.size(), 0u);
    EXPECT_LE(found().leverage.indices.size(), 1 + found().estimate.inliers / kInliersALeverage);
    EXPECT_GT(parts_.work.samples, found().searched.iterations) << viewpoint;
    EXPECT_EQ(found().outcome, Outcome::kUncertain) << viewpoint;
  }
}

// Every byte by `amount` up or down, so that descriptors are known to lie so far apart.
Descriptor shifted(Descriptor descriptor, int amount, Random *random) {
  for (uint8_t &byte : descriptor.bytes) {
    const bool up = byte < amount || (byte <= 255 - amount && random->below(2));
    byte = static_cast<uint8_t>(up ? byte + amount : byte - amount);
  }
  return descriptor;
}

constexpr double kMovedM = 0.4;

// One point in twenty has moved, all of these together: a small core that agrees with itself.  Of the others each
// has a near-duplicate elsewhere, so that it passes the ratio test at 0.89 and not before; or they are not in the
// map.
std::vector<test::WorldPoint> movedCore(bool with_others) {
  Random random(5);
  std::vector<test::WorldPoint> points;
  uint32_t number = 0;
  for (const test::WorldPoint &point : pointsOfTheRoom()) {
    if (number++ % 20 == 0) {
      points.push_back(point);
      points.back().position_m += Vector3(kMovedM, 0, 0);
    } else if (with_others) {
      points.push_back(point);
      points.back().descriptor = shifted(point.descriptor, 8, &random);
      points.push_back(
          {Vector3(0, 0, 1) + 3 * test::randomDirection(&random), shifted(point.descriptor, 9, &random)});
    }
  }
  return points;
}

class MovedCoreTest : public VerificationTest {
 protected:
  explicit MovedCoreTest(bool with_others = true)
      : VerificationTest(mapOf(movedCore(with_others), Vector3(0, 0, 1))) {}
};

class MovedCoreAloneTest : public MovedCoreTest {
 protected:
  MovedCoreAloneTest() : MovedCoreTest(false) {}
};

// Nothing contradicts it.
TEST_F(MovedCoreAloneTest, IsFoundAgainAndBelieved) {
  verify(seen(0));
  EXPECT_LT(found().estimate.inliers, kInliersBeyondConfirmation);
  EXPECT_EQ(found().outcome, Outcome::kLocalized);
  EXPECT_NEAR(errorM(0), kMovedM, 0.05);
}

TEST_F(MovedCoreTest, APoseThatALooserSearchContradictsIsNotBelieved) {
  verify(seen(0));
  EXPECT_LT(found().estimate.inliers, kInliersBeyondConfirmation);
  EXPECT_NEAR(errorM(0), kMovedM, 0.05);
  EXPECT_EQ(judgePose(found().evidence, found().estimate, min_inliers_), Outcome::kLocalized);
  EXPECT_EQ(found().outcome, Outcome::kUncertain);
}

// Where a pose was expected, that speaks for it.
TEST_F(MovedCoreTest, AnExpectedPoseNeedsNoConfirmation) {
  const PoseTask task = seen(0);
  found().guided = true;
  verify(task);
  EXPECT_EQ(found().outcome, Outcome::kLocalized);
}

}  // namespace
}  // namespace sphc
