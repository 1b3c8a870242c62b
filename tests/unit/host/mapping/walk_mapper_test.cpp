#include "host/mapping/walk_mapper.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/mapping/stretches.h"
#include "host/report/trajectory_score.h"
#include "made_up_walk.h"
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
  const MappedWalk mapped = mapWalk(made.walk, {});
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
  const MappedWalk once = mapWalk(made.walk, {}), again = mapWalk(made.walk, {});
  for (size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(once.world_from_camera[i]->rotation, again.world_from_camera[i]->rotation);
    EXPECT_EQ(once.world_from_camera[i]->translation_m, again.world_from_camera[i]->translation_m);
  }
}

TEST(WalkMapperTest, TwoPartsThatNeverMetAreToldApart) {
  const MadeUpWalk made = joined(makeWalk({30, 1, 1}), makeWalk({20, 0.5, 1, 0, 0, 2}));
  const MappedWalk mapped = mapWalk(made.walk, {});
  const Stretches stretches = stretchesOf(made.walk, mapped.parts);
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
  const MappedWalk mapped = mapWalk(made.walk, {});
  EXPECT_FALSE(mapped.world_from_camera[10]);
  EXPECT_TRUE(mapped.world_from_camera[19]);
  EXPECT_EQ(stretchesOf(made.walk, mapped.parts).left_out.size(), 1u);
}

TEST(WalkMapperTest, FramesOfWhichNoTwoAgreeAreRefused) {
  const MadeUpWalk made = joined(makeWalk({1}), makeWalk({1, 1, 0, 0, 0, 2}));
  EXPECT_THAT(test::refusal([&] { mapWalk(made.walk, {}); }),
              testing::HasSubstr("no two frames of the walk agree"));
}

}  // namespace
}  // namespace sphc::host
