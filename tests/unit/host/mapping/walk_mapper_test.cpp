#include "host/mapping/walk_mapper.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "host/mapping/stretches.h"
#include "host/report/trajectory_score.h"
#include "made_up_walk.h"
#include "tests/support/random_numbers.h"
#include "tests/support/refusal.h"

namespace sphc::host {
namespace {

TrajectoryScore scoreOf(const MadeUpWalk &made, const MappedWalk &mapped) {
  std::vector<PosePair> pairs;
  for (size_t i = 0; i < made.world_from_camera.size(); ++i)
    if (mapped.world_from_camera[i]) pairs.push_back({*mapped.world_from_camera[i], made.world_from_camera[i]});
  return scoreTrajectory(pairs);
}

TEST(WalkMapperTest, AWalkOfTwoTurnsIsMapped) {
  const MadeUpWalk made = makeWalk({50, 2, 1});
  const MappedWalk mapped = mapWalk(made.walk, {}, {});
  const TrajectoryScore score = scoreOf(made, mapped);
  EXPECT_EQ(score.frames, 50u);
  EXPECT_LT(score.rigid_rmse_m, 0.003);
  EXPECT_LT(score.rotation_worst_deg, 0.15);
  EXPECT_GT(mapped.loops, 20u);
  EXPECT_EQ(mapped.contradicting, 0u);
  EXPECT_TRUE(mapped.world_from_camera[0]->rotation.isIdentity(1e-9)) << "the world is the first frame";
}

TEST(WalkMapperTest, TheSameWalkGivesTheSameBits) {
  const MadeUpWalk made = makeWalk({20, 0.5, 1});
  const MappedWalk once = mapWalk(made.walk, {}, {}), again = mapWalk(made.walk, {}, {});
  for (size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(once.world_from_camera[i]->rotation, again.world_from_camera[i]->rotation);
    EXPECT_EQ(once.world_from_camera[i]->translation_m, again.world_from_camera[i]->translation_m);
  }
}

// The poses are not used, and their residuals say that they are bent.
TEST(WalkMapperTest, PosesThatWereToldAreJudged) {
  MadeUpWalk made = makeWalk({20, 0.5, 1});
  MappingOptions options;
  options.judges_told = true;
  EXPECT_FALSE(mapWalk(made.walk, options, {}).residuals_of_told);  // nothing was told
  for (size_t i = 0; i < 20; ++i) made.walk.keyframes[i].told_world_from_camera = made.world_from_camera[i];
  const MappedWalk sound = mapWalk(made.walk, options, {});
  EXPECT_NEAR(sound.residuals_of_told->ray_sigmas, sound.residuals.ray_sigmas, 0.1);
  EXPECT_NEAR(sound.residuals_of_told->depth_sigmas, sound.residuals.depth_sigmas, 0.1);
  for (size_t i = 0; i < 20; ++i)
    made.walk.keyframes[i].told_world_from_camera->translation_m.x() += 0.03 * std::sin(static_cast<double>(i));
  const MappedWalk bent = mapWalk(made.walk, options, {});
  EXPECT_GT(bent.residuals_of_told->ray_sigmas, 2 * bent.residuals.ray_sigmas);
  EXPECT_EQ(bent.world_from_camera[7]->translation_m, sound.world_from_camera[7]->translation_m);
}

TEST(WalkMapperTest, TwoPartsThatNeverMetAreToldApart) {
  const MadeUpWalk made = joined(makeWalk({30, 1, 1}), makeWalk({20, 0.5, 1, 0, 0, 2}));
  const MappedWalk mapped = mapWalk(made.walk, {}, {});
  const Stretches stretches = stretchesOf(made.walk, mapped.parts, mapped.world_from_camera);
  ASSERT_EQ(stretches.mapped.size(), 1u);
  EXPECT_EQ(stretches.mapped[0].first, 0u);
  EXPECT_EQ(stretches.mapped[0].last, 29u);
  ASSERT_EQ(stretches.apart.size(), 1u);
  EXPECT_EQ(stretches.apart[0][0].first, 30u);
  EXPECT_EQ(stretches.apart[0][0].last, 49u);
  EXPECT_FALSE(mapped.world_from_camera[30]);
}

// A frame that shows something else, amid the walk.
TEST(WalkMapperTest, AFrameThatAgreesWithNoneIsLeftOut) {
  MadeUpWalk made = makeWalk({20, 0.5, 1});
  const MadeUpWalk other = makeWalk({1, 1, 1, 0, 0, 2});
  made.walk.keyframes[10].points = other.walk.keyframes[0].points;
  made.walk.keyframes[10].descriptors = other.walk.keyframes[0].descriptors;
  const MappedWalk mapped = mapWalk(made.walk, {}, {});
  EXPECT_FALSE(mapped.world_from_camera[10]);
  EXPECT_TRUE(mapped.world_from_camera[19]);
  EXPECT_EQ(stretchesOf(made.walk, mapped.parts, mapped.world_from_camera).left_out.size(), 1u);
}

bool sees(const WalkFrame &frame, const Descriptor &descriptor) {
  return std::any_of(frame.descriptors.begin(), frame.descriptors.end(), [&](const Descriptor &of_frame) {
    return std::equal(std::begin(of_frame.bytes), std::end(of_frame.bytes), std::begin(descriptor.bytes));
  });
}

// Of what the other frame sees too so many points stay.
WalkFrame withFewOf(const WalkFrame &other, size_t most, const WalkFrame &frame) {
  WalkFrame kept = frame;
  kept.points.clear();
  kept.descriptors.clear();
  size_t shared = 0;
  for (size_t i = 0; i < frame.points.size(); ++i) {
    if (sees(other, frame.descriptors[i]) && shared++ >= most) continue;
    kept.points.push_back(frame.points[i]);
    kept.descriptors.push_back(frame.descriptors[i]);
  }
  return kept;
}

// The last frame shares all but three of its points with one frame alone.
TEST(WalkMapperTest, WhatTwoFramesSeeHoldsThemTogether) {
  MadeUpWalk made = makeWalk({20, 0.5, 1});
  std::vector<WalkFrame> &frames = made.walk.keyframes;
  frames[19] = withFewOf(frames[17], 3, frames[19]);
  const MappedWalk mapped = mapWalk(made.walk, {}, {});
  ASSERT_TRUE(mapped.world_from_camera[19]);
  const Rigid step = mapped.world_from_camera[19]->inverse() * *mapped.world_from_camera[18];
  const Rigid off = step * stepOf(made, {18, 19}).inverse();
  EXPECT_LT(off.translation_m.norm(), 0.02);
  EXPECT_LT(rotationAngle(off.rotation), 0.01);
}

// Moves and turns the told poses by chance, and shifts all of them into a world of their own.
const Rigid kToldWorld = {rotationFromVector(Vector3(0.3, 1, -0.2)), Vector3(5, -3, 2)};
void tellTheTruth(MadeUpWalk *made, double off_m, double off_rad) {
  Random random(5);
  for (size_t i = 0; i < made->world_from_camera.size(); ++i) {
    made->world_from_camera[i] = kToldWorld * made->world_from_camera[i];
    Rigid told = made->world_from_camera[i];
    told.translation_m += off_m * test::normalVector(&random);
    told.rotation *= rotationFromVector(off_rad * test::normalVector(&random));
    made->walk.keyframes[i].told_world_from_camera = told;
  }
}

PoseTrust trustIn(PoseUse use) {
  PoseTrust trust;
  trust.use = use;
  return trust;
}

double worstOffM(const MadeUpWalk &made, const MappedWalk &mapped) {
  double worst_m = 0;
  for (size_t i = 0; i < made.world_from_camera.size(); ++i)
    if (mapped.world_from_camera[i])
      worst_m = std::max(
          worst_m, (mapped.world_from_camera[i]->translation_m - made.world_from_camera[i].translation_m).norm());
  return worst_m;
}

TEST(WalkMapperTest, ApproximatePosesGiveTheirWorldAndCostNothing) {
  MadeUpWalk made = makeWalk({50, 2, 1});
  tellTheTruth(&made, 0.05, 0.0175);
  const MappedWalk mapped = mapWalk(made.walk, {trustIn(PoseUse::kApproximate)}, {});
  EXPECT_TRUE(mapped.is_in_told_world);
  EXPECT_LT(scoreOf(made, mapped).rigid_rmse_m, 0.003);
  EXPECT_LT(worstOffM(made, mapped), 0.04);
  EXPECT_LE(mapped.told_wrong, 1u);
}

// A jump, a pose that is no number, and a tracking that begins anew elsewhere.
TEST(WalkMapperTest, HostilePosesAreNamedAndSpoilNothing) {
  MadeUpWalk made = makeWalk({50, 2, 1});
  tellTheTruth(&made, 0.002, 0.001);
  std::vector<WalkFrame> &frames = made.walk.keyframes;
  frames[7].told_world_from_camera->translation_m.x() += 100;
  frames[8].told_world_from_camera->translation_m.x() = std::nan("");
  for (size_t i = 40; i < 50; ++i)
    frames[i].told_world_from_camera =
        Rigid{Matrix3::Identity(), Vector3(100, 0, 0)} * *frames[i].told_world_from_camera;
  for (PoseUse use : {PoseUse::kApproximate, PoseUse::kOdometry}) {
    const MappedWalk mapped = mapWalk(made.walk, {trustIn(use)}, {});
    const TrajectoryScore score = scoreOf(made, mapped);
    EXPECT_EQ(score.frames, 50u);
    EXPECT_LT(score.rigid_rmse_m, 0.003);
    EXPECT_EQ(mapped.told, use == PoseUse::kApproximate ? 49u : 48u);
    EXPECT_GE(mapped.told_wrong, use == PoseUse::kApproximate ? 11u : 3u);
    EXPECT_LE(mapped.told_wrong, 14u);
  }
}

TEST(WalkMapperTest, PosesOfAnotherWalkAreNotUsed) {
  MadeUpWalk made = makeWalk({50, 2, 1});
  tellTheTruth(&made, 3, 1);
  for (PoseUse use : {PoseUse::kApproximate, PoseUse::kOdometry}) {
    const MappedWalk mapped = mapWalk(made.walk, {trustIn(use)}, {});
    EXPECT_TRUE(mapped.is_unbelieved);
    EXPECT_FALSE(mapped.is_in_told_world);
    EXPECT_LT(scoreOf(made, mapped).rigid_rmse_m, 0.003);
    EXPECT_TRUE(mapped.world_from_camera[0]->rotation.isIdentity(1e-9));
  }
}

// Half a turn, frames that show nothing, and what was behind: no image links the two.
MadeUpWalk acrossABareCorridor() {
  MadeUpWalk made = makeWalk({40, 1, 1});
  for (uint32_t i = 11; i < 40; ++i) {
    if (i >= 19 && i < 28) continue;
    made.walk.keyframes[i].points.clear();
    made.walk.keyframes[i].descriptors.clear();
  }
  return made;
}

TEST(WalkMapperTest, OdometryBridgesWhatImagesDoNot) {
  MadeUpWalk made = acrossABareCorridor();
  tellTheTruth(&made, 0, 0);
  const MappedWalk without = mapWalk(made.walk, {}, {}),
                   with = mapWalk(made.walk, {trustIn(PoseUse::kOdometry)}, {});
  EXPECT_TRUE(!without.world_from_camera[4] || !without.world_from_camera[24]);
  EXPECT_TRUE(with.world_from_camera[4] && with.world_from_camera[14] && with.world_from_camera[24]);
  EXPECT_LT(scoreOf(made, with).rigid_rmse_m, 0.01);
  EXPECT_EQ(with.told_wrong, 0u);
  EXPECT_FALSE(with.by_told_alone[4]);
  EXPECT_TRUE(with.by_told_alone[14] && with.by_told_alone[24]) << "which is to be said";
  for (bool alone : without.by_told_alone) EXPECT_FALSE(alone);
}

// The tracking is lost after one room, and begins anew in another.
TEST(WalkMapperTest, OdometryThatBeganAnewJoinsNoRooms) {
  MadeUpWalk made = joined(makeWalk({30, 1, 1}), makeWalk({20, 0.5, 1, 0, 0, 2}));
  tellTheTruth(&made, 0, 0);
  for (size_t i = 30; i < 50; ++i) {
    made.walk.keyframes[i].time_ns += 30000000000;
    made.walk.keyframes[i].told_piece = 1;
  }
  const MappedWalk mapped = mapWalk(made.walk, {trustIn(PoseUse::kOdometry)}, {});
  EXPECT_TRUE(mapped.world_from_camera[29]);
  EXPECT_FALSE(mapped.world_from_camera[30]);
  EXPECT_EQ(mapped.told_wrong, 0u);
}

TEST(WalkMapperTest, ApproximatePosesPlacePartsThatNeverMet) {
  MadeUpWalk made = acrossABareCorridor();
  tellTheTruth(&made, 0.02, 0.005);
  const MappedWalk mapped = mapWalk(made.walk, {trustIn(PoseUse::kApproximate)}, {});
  EXPECT_TRUE(mapped.world_from_camera[4] && mapped.world_from_camera[24]);
  EXPECT_FALSE(mapped.world_from_camera[14]) << "nothing was seen from there";
  EXPECT_LT(worstOffM(made, mapped), 0.05);
}

// The larger part was told nothing: it is mapped in a world of its own.
TEST(WalkMapperTest, PosesOfASmallerPartHoldNothing) {
  MadeUpWalk made = joined(makeWalk({30, 1, 1}), makeWalk({20, 0.5, 1, 0, 0, 2}));
  tellTheTruth(&made, 0, 0);
  for (size_t i = 0; i < 30; ++i) made.walk.keyframes[i].told_world_from_camera.reset();
  const MappedWalk mapped = mapWalk(made.walk, {trustIn(PoseUse::kApproximate)}, {});
  EXPECT_EQ(scoreOf(made, mapped).frames, 30u);
  EXPECT_TRUE(mapped.world_from_camera[0]->rotation.isIdentity(1e-9));
  EXPECT_FALSE(mapped.is_in_told_world);
  EXPECT_TRUE(mapped.is_unbelieved);
  EXPECT_EQ(mapped.told, 20u);
  EXPECT_EQ(mapped.told_wrong, 0u);
}

TEST(WalkMapperTest, OdometryGivesTheAxesWhereThatIsAskedFor) {
  MadeUpWalk made = makeWalk({20, 0.5, 1});
  tellTheTruth(&made, 0, 0);
  PoseTrust trust = trustIn(PoseUse::kOdometry);
  trust.keeps_axes = true;
  const MappedWalk mapped = mapWalk(made.walk, {trust}, {});
  for (size_t i = 0; i < 20; ++i)
    EXPECT_LT(rotationAngle(mapped.world_from_camera[i]->rotation * made.world_from_camera[i].rotation.transpose()),
              0.005);
  EXPECT_TRUE(mapped.world_from_camera[0]->translation_m.isZero(1e-9));
  EXPECT_TRUE(mapped.has_told_axes);
}

TEST(WalkMapperTest, OdometryOfASmallerPartGivesNoAxes) {
  MadeUpWalk made = joined(makeWalk({30, 1, 1}), makeWalk({20, 0.5, 1, 0, 0, 2}));
  tellTheTruth(&made, 0, 0);
  for (size_t i = 0; i < 30; ++i) made.walk.keyframes[i].told_world_from_camera.reset();
  PoseTrust trust = trustIn(PoseUse::kOdometry);
  trust.keeps_axes = true;
  EXPECT_FALSE(mapWalk(made.walk, {trust}, {}).has_told_axes);
}

// The other half of the turn, and the first half once more, by somebody else.
TEST(WalkMapperTest, RecordingsAreJoinedByLoopsAndOneThatNeverMetStaysAway) {
  const MadeUpWalk made =
      joined(joined(makeWalk({30, 1, 1}), makeWalk({30, 1, 1})), makeWalk({12, 0.3, 1, 0, 0, 2}));
  std::vector<Walk> walks(3);
  for (size_t i = 0; i < made.walk.keyframes.size(); ++i)
    walks[i < 30 ? 0 : i < 60 ? 1 : 2].keyframes.push_back(made.walk.keyframes[i]);
  const Walk all = joinWalks(walks);
  EXPECT_EQ(all.keyframes[45].recording, 1u);
  const MappedWalk mapped = mapWalk(all, {}, {});
  EXPECT_GT(mapped.loops, 30u);
  EXPECT_LT(scoreOf(made, mapped).rigid_rmse_m, 0.003);
  EXPECT_TRUE(mapped.world_from_camera[59]);
  EXPECT_FALSE(mapped.world_from_camera[60]);
}

TEST(WalkMapperTest, FramesOfWhichNoTwoAgreeAreRefused) {
  const MadeUpWalk made = joined(makeWalk({1}), makeWalk({1, 1, 0, 0, 0, 2}));
  EXPECT_THAT(test::refusal([&] { mapWalk(made.walk, {}, {}); }),
              testing::HasSubstr("no two frames of the walk agree"));
}

// Focal lengths that are off, and depths of another scale in one of the frames, so that their links contradict.
MadeUpWalk contradicting(MadeUpWalk made, double rays, size_t other_scale) {
  for (WalkFrame &frame : made.walk.keyframes)
    for (SeenPoint &point : frame.points) {
      point.ray *= rays;
      point.bearing = Vector3(point.ray.x(), point.ray.y(), 1).normalized();
    }
  for (SeenPoint &point : made.walk.keyframes[other_scale].points) point.depth_m *= 1.3;
  return made;
}

// The largest part falls to pieces, and the next one takes its place.
TEST(WalkMapperTest, APartThatContradictsItselfTakesNoOtherWithIt) {
  const MadeUpWalk made = joined(contradicting(makeWalk({3, 0.3, 1}), 0.7, 1), makeWalk({2, 0.1, 1, 0, 0, 2}));
  const MappedWalk mapped = mapWalk(made.walk, {}, {});
  for (size_t i = 0; i < 3; ++i) EXPECT_FALSE(mapped.world_from_camera[i]);
  ASSERT_TRUE(mapped.world_from_camera[3] && mapped.world_from_camera[4]);
  const Rigid step = mapped.world_from_camera[4]->inverse() * *mapped.world_from_camera[3];
  EXPECT_LT((step * stepOf(made, {3, 4}).inverse()).translation_m.norm(), 0.02);
  EXPECT_GT(mapped.contradicting, 0u);
}

TEST(WalkMapperTest, WhereAllLinksContradictTheCalibrationIsNamedToo) {
  // Of the second walk the first frame keeps a pose, and no link.
  for (const MadeUpWalk &made :
       {contradicting(makeWalk({3, 0.3, 1}), 0.7, 1), contradicting(makeWalk({2, 0.2 / 3, 1}), 1.43, 0)}) {
    try {
      mapWalk(made.walk, {}, {});
      FAIL() << "the walk was mapped";
    } catch (const NothingAgrees &error) {  // which lets `map` say what was measured
      EXPECT_THAT(error.what(),
                  testing::AllOf(testing::HasSubstr("contradict each other"), testing::HasSubstr("focal lengths"),
                                 testing::HasSubstr("spherecloud doctor")));
    }
  }
}

}  // namespace
}  // namespace sphc::host
