#include "runtime/localizer/hypothesis.h"

#include <gtest/gtest.h>

#include <utility>

#include "tests/unit/runtime/localizer/room_parts.h"

namespace sphc {
namespace {

class HypothesisTest : public testing::Test {
 protected:
  void SetUp() override { parts_.see(0); }
  const MapView &map() const { return parts_.search.map(0); }
  void assign(MatchSet *matched, const std::vector<Match> &matches) {
    std::copy(matches.begin(), matches.end(), matched->room().begin());
    matched->assign(static_cast<uint32_t>(matches.size()), parts_.front, map());
  }

  test::RoomParts parts_;
};

TEST_F(HypothesisTest, ACorrespondenceIsTheKeypointThePointAndHowClearTheMatchWas) {
  const Correspondence c = correspondenceOf({5, 17, 300, 1199}, parts_.front, map());
  EXPECT_EQ(c.lifted.point_m, parts_.front.lifted()[5].point_m);
  EXPECT_EQ(c.lifted.along_m, parts_.front.lifted()[5].along_m);
  const Direction d = map().direction(17);
  EXPECT_EQ(c.direction, Vector3(static_cast<double>(d.x), static_cast<double>(d.y), static_cast<double>(d.z)));
  EXPECT_FLOAT_EQ(c.quality, 0.75f);  // 1 - 300 / (1199 + 1)
}

// The runner-up may be as near as nothing.
TEST_F(HypothesisTest, QualityIsFiniteWhereBothDescriptorsAreTheSame) {
  EXPECT_EQ(correspondenceOf({0, 0, 0, 0}, parts_.front, map()).quality, 1.0f);
}

TEST_F(HypothesisTest, EarlierFramesStandBehindThisOne) {
  MatchSet &matched = parts_.found.matched;
  assign(&matched, {{3, 8, 10, 40}, {1, 9, 10, 80}});
  matched.add({{Vector3(1, 2, 3), 0.1, 0.2}, Vector3(0, 0, 1), 0.5f});
  ASSERT_EQ(matched.matches().size(), 2u);
  ASSERT_EQ(matched.ofThisFrame().size(), 2u);
  ASSERT_EQ(matched.all().size(), 3u);
  EXPECT_EQ(matched.all()[0].lifted.point_m, parts_.front.lifted()[3].point_m);
  EXPECT_EQ(matched.all()[1].direction, directionOf(map(), 9));
  EXPECT_EQ(matched.all()[2].lifted.point_m, Vector3(1, 2, 3));
  assign(&matched, {{2, 4, 10, 40}});  // a new match of this frame: the earlier ones are gone
  EXPECT_EQ(matched.all().size(), 1u);
  matched.clear();
  EXPECT_TRUE(matched.matches().empty());
  EXPECT_TRUE(matched.all().empty());
}

TEST_F(HypothesisTest, ThereIsRoomForEveryKeypointOfThisFrameAndOfEarlierOnes) {
  const uint32_t most = parts_.config.max_keypoints;
  MatchSet &matched = parts_.found.matched, &other = parts_.rival.matched;
  ASSERT_EQ(matched.room().size(), most);
  assign(&other, {{7, 7, 10, 40}});
  assign(&matched, std::vector<Match>(most, Match{1, 2, 10, 40}));
  for (uint32_t i = 0; i < most; ++i) matched.add({{Vector3(0, 0, i), 0.1, 0.2}, Vector3(0, 0, 1), 0});
  ASSERT_EQ(matched.all().size(), 2 * most);
  EXPECT_EQ(matched.all()[2 * most - 1].lifted.point_m.z(), most - 1);
  // and what another holds is elsewhere
  EXPECT_EQ(other.matches()[0].query, 7u);
  EXPECT_EQ(other.all()[0].direction, directionOf(map(), 7));
}

TEST_F(HypothesisTest, AnotherAttemptForgetsTheOneBefore) {
  Hypothesis &hypothesis = parts_.found;
  const Match *memory = hypothesis.matched.room().data();
  EXPECT_FALSE(hypothesis.tried);
  assign(&hypothesis.matched, {{1, 2, 10, 40}});
  hypothesis.guided = true;
  hypothesis.outcome = Outcome::kLocalized;
  hypothesis.evidence.log_chance_first = -50;
  hypothesis.estimate.inliers = 40;
  hypothesis.leverage.centre_sigma_ratio = 3;
  hypothesis.begin(4, 9);
  EXPECT_TRUE(hypothesis.tried);
  EXPECT_EQ(hypothesis.map, 4u);
  EXPECT_EQ(hypothesis.frames, 9u);
  EXPECT_FALSE(hypothesis.guided);
  EXPECT_FALSE(hypothesis.isLocalized());
  EXPECT_EQ(hypothesis.evidence.log_chance_first, 0);
  EXPECT_EQ(hypothesis.estimate.inliers, 0u);
  EXPECT_EQ(hypothesis.leverage.centre_sigma_ratio, 1);
  EXPECT_TRUE(hypothesis.matched.all().empty());
  EXPECT_EQ(hypothesis.matched.room().data(), memory);
}

TEST_F(HypothesisTest, AChallengerTakesAllButTheMatches) {
  Hypothesis &best = parts_.found, &rival = parts_.rival;
  const Match *memory = rival.matched.room().data();
  best.begin(3);
  best.outcome = Outcome::kLocalized;
  best.estimate.inliers = 40;
  assign(&best.matched, {{1, 2, 10, 40}});
  assign(&rival.matched, {{5, 6, 10, 40}, {6, 7, 10, 40}});
  rival.challenge(best);
  EXPECT_EQ(rival.map, 3u);
  EXPECT_TRUE(rival.isLocalized());
  EXPECT_EQ(rival.estimate.inliers, 40u);
  EXPECT_TRUE(rival.matched.all().empty());
  EXPECT_EQ(rival.matched.room().data(), memory);
  ASSERT_EQ(best.matched.matches().size(), 1u);
  EXPECT_EQ(best.matched.matches()[0].query, 1u);
}

TEST_F(HypothesisTest, SwappedHypothesesKeepTheirMatches) {
  Hypothesis &best = parts_.found, &rival = parts_.rival;
  assign(&best.matched, {{1, 2, 10, 40}});
  assign(&rival.matched, {{5, 6, 10, 40}, {6, 7, 10, 40}});
  rival.estimate.inliers = 11;
  std::swap(best, rival);
  EXPECT_EQ(best.estimate.inliers, 11u);
  ASSERT_EQ(best.matched.matches().size(), 2u);
  EXPECT_EQ(best.matched.matches()[1].point_index, 7u);
  ASSERT_EQ(rival.matched.matches().size(), 1u);
  EXPECT_EQ(rival.matched.all()[0].direction, directionOf(map(), 2));
}

}  // namespace
}  // namespace sphc
