#include "runtime/localizer/search.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "runtime/localizer/tuning.h"
#include "tests/unit/runtime/localizer/room_parts.h"

namespace sphc {
namespace {

using tuning::degrees;

TEST(SearchCone, GrowsWithTheErrorOfThePose) {
  EXPECT_DOUBLE_EQ(coneOf({}), tuning::kLeastConeRad);
  const double turned = coneOf({0, {}, 0.04, 0}), moved = coneOf({0, {}, 0, 0.1}),
               both = coneOf({0, {}, 0.04, 0.1});
  EXPECT_NEAR(turned, tuning::kConeSigmas * 0.04, 1e-12);
  EXPECT_NEAR(moved, tuning::kConeSigmas * 0.1 / tuning::kTypicalDepthM, 1e-12);
  EXPECT_NEAR(both, turned + moved, 1e-12);
}

TEST(SearchCone, SolidAngle) {
  EXPECT_NEAR(solidAngleOf(kPi), 4 * kPi, 1e-12);
  EXPECT_NEAR(solidAngleOf(kPi / 2), 2 * kPi, 1e-12);
  EXPECT_NEAR(solidAngleOf(0.01), kPi * 0.01 * 0.01, 1e-8);
}

Known knownPose(double rotation_sigma_rad, uint32_t map = 0) {
  Known known;
  known.map = map;
  known.prior.has_pose = true;
  known.prior.camera_from_map.translation_m = Vector3(1, 2, 3);
  known.prior.rotation_sigma_rad = rotation_sigma_rad;
  known.prior.translation_sigma_m = 0.01;
  return known;
}

Tracker trackerOf(uint32_t map, double sigma_rad) {
  Tracker tracker;
  Estimate estimate;
  estimate.inliers = 500;
  estimate.camera_from_map.translation_m = Vector3(4, 5, 6);
  estimate.covariance = sigma_rad * sigma_rad * Matrix6::Identity();
  tracker.advance(1000, nullptr);
  tracker.accept(map, estimate, 1);
  tracker.advance(1001, nullptr);
  return tracker;
}

TEST(ExpectedPose, TheCallersNarrowOneComesFirst) {
  const Tracker tracker = trackerOf(7, 1e-3);
  Prediction expected;
  ASSERT_TRUE(expectedPose(knownPose(0.01, 3), &tracker, tuning::kMostConeRad, &expected));
  EXPECT_EQ(expected.map, 3u);
  EXPECT_EQ(expected.camera_from_map.translation_m, Vector3(1, 2, 3));
  EXPECT_EQ(expected.rotation_sigma_rad, 0.01);
  EXPECT_EQ(expected.translation_sigma_m, 0.01);
}

TEST(ExpectedPose, AVagueOneLeavesItToEarlierFrames) {
  const Tracker tracker = trackerOf(7, 1e-3);
  const Known vague = knownPose(degrees(10));
  EXPECT_FALSE(isNarrow(vague));
  EXPECT_FALSE(isNarrow(Known()));
  EXPECT_TRUE(isNarrow(knownPose(0.01)));
  Prediction expected;
  ASSERT_TRUE(expectedPose(vague, &tracker, tuning::kMostConeRad, &expected));
  EXPECT_EQ(expected.map, 7u);
  EXPECT_EQ(expected.camera_from_map.translation_m, Vector3(4, 5, 6));
}

TEST(ExpectedPose, NoneWhereNothingNarrowsTheSearch) {
  Prediction expected;
  const Tracker fresh, vague = trackerOf(7, 0.2);
  EXPECT_FALSE(expectedPose(Known(), nullptr, tuning::kMostConeRad, &expected));
  EXPECT_FALSE(expectedPose(Known(), &fresh, tuning::kMostConeRad, &expected));
  EXPECT_FALSE(expectedPose(knownPose(degrees(10)), &vague, tuning::kMostConeRad, &expected));
}

TEST(ExpectedPose, AWiderConeAdmitsAVaguerOne) {
  const Tracker vague = trackerOf(7, degrees(3));
  Prediction expected;
  EXPECT_FALSE(expectedPose(Known(), &vague, tuning::kMostConeRad, &expected));
  EXPECT_TRUE(expectedPose(Known(), &vague, tuning::kMostConeInHasteRad, &expected));
}

// A clock that moves on by a microsecond each time it is read.
int64_t tick(void *user) { return *static_cast<int64_t *>(user) += 1000; }

class SearchTest : public testing::Test {
 protected:
  std::vector<uint32_t> rank(uint32_t room) {
    parts_.see(0, room);
    const MapOrder order = parts_.search.rankMaps(parts_.front, {}, &parts_.work);
    return {order.begin(), order.end()};
  }
  MatchSet &matched() { return parts_.found.matched; }
  Span<const Match> everywhere(uint32_t keypoints, uint32_t map = 0) {
    parts_.search.matchEverywhere(parts_.askAll(map), keypoints, {}, &matched(), &parts_.work);
    return matched().matches();
  }

  test::RoomParts parts_{0.5, 4};
};

TEST_F(SearchTest, TheRoomThatIsSeenIsTheLikeliest) {
  for (uint32_t room = 0; room < 4; ++room) {
    const auto order = rank(room);
    ASSERT_FALSE(order.empty());
    EXPECT_EQ(order[0], room);
    EXPECT_EQ(order.size(), 1u) << "rooms that nothing speaks for";
  }
}

// Where nothing speaks for any, the first ones are tried, and not all.
TEST_F(SearchTest, WithoutASignOnlySoManyAreTried) {
  parts_.see(0);
  parts_.lift(std::vector<uint16_t>(200 * 160));
  const MapOrder order = parts_.search.rankMaps(parts_.front, {}, &parts_.work);
  EXPECT_EQ((std::vector<uint32_t>(order.begin(), order.end())), (std::vector<uint32_t>{0, 1, 2}));
}

TEST_F(SearchTest, OneMapNeedsNoVote) {
  test::RoomParts alone;
  alone.see(0);
  int64_t now = 0;
  alone.config.clock = {tick, &now};
  alone.search.init(alone.config);
  EXPECT_EQ(alone.search.rankMaps(alone.front, {}, &alone.work).size(), 1u);
  EXPECT_EQ(alone.work.match_ns, 0u);
}

TEST_F(SearchTest, EverywhereFindsTheRealPointsOfItsRoom) {
  parts_.see(1);
  const Rigid truth = parts_.cameraFromMap(1);
  const auto matches = everywhere(parts_.front.keypointCount());
  ASSERT_EQ(matches.size(), matched().ofThisFrame().size());
  ASSERT_GT(matches.size(), 50u);
  const auto near = [&](const Correspondence &c) { return parts_.angleOff(c, truth) < degrees(1); };
  const auto right = std::count_if(matched().all().begin(), matched().all().end(), near);
  EXPECT_GT(right, static_cast<ptrdiff_t>(matches.size()) / 4);  // half of the map's points are fakes
  EXPECT_LT(everywhere(parts_.front.keypointCount(), 1).size(), matches.size() / 4) << "in another room";
}

TEST_F(SearchTest, OnlyTheFirstKeypointsAreMatched) {
  parts_.see(0);
  const auto few = everywhere(40);
  ASSERT_GT(few.size(), 10u);
  for (const Match &match : few) EXPECT_LT(match.query, 40u);
  const size_t some = few.size();
  EXPECT_GT(everywhere(parts_.front.keypointCount()).size(), some);
}

TEST_F(SearchTest, NearAPoseEveryMatchIsInItsCone) {
  parts_.see(1);
  const Rigid truth = parts_.cameraFromMap(1);
  const auto question = parts_.askAll();
  for (const double cone_rad : {degrees(1), degrees(4)}) {
    parts_.search.matchNear(question, truth, cone_rad, {}, {}, &matched(), &parts_.work);
    EXPECT_GT(matched().all().size(), 50u);
    for (const Correspondence &c : matched().all()) EXPECT_LT(parts_.angleOff(c, truth), cone_rad + 1e-4);
    for (const Match &match : matched().matches()) EXPECT_LT(match.query, parts_.front.liftedCount());
  }
}

TEST_F(SearchTest, NearAPoseTheRaysStandBehind) {
  parts_.see(1);
  const uint32_t lifted = parts_.front.liftedCount();
  ASSERT_LT(lifted, parts_.front.keypointCount()) << "the frame has no keypoint without depth";
  const Match rays[] = {{lifted, 5, 10, 40}};
  const auto question = parts_.askAll();
  parts_.search.matchNear(question, parts_.cameraFromMap(1), degrees(2), {}, {}, &matched(), &parts_.work);
  const size_t without = matched().matches().size();
  parts_.search.matchNear(question, parts_.cameraFromMap(1), degrees(2), {rays, 1}, {}, &matched(), &parts_.work);
  ASSERT_EQ(matched().matches().size(), without + 1);
  EXPECT_EQ(matched().matches()[without].point_index, 5u);
  EXPECT_FALSE(matched().all()[without].lifted.hasDepth());
}

TEST_F(SearchTest, RaysAreTheMatchesOfKeypointsWithoutDepth) {
  parts_.see(0);
  const uint32_t lifted = parts_.front.liftedCount();
  ASSERT_LT(lifted, parts_.front.keypointCount());
  const Match mixed[] = {{0, 1, 10, 40}, {lifted, 2, 10, 40}, {lifted - 1, 3, 10, 40}};
  std::copy(std::begin(mixed), std::end(mixed), matched().room().begin());
  matched().assign(3, parts_.front, parts_.search.map(0));
  const Span<const Match> rays = parts_.search.raysOf(parts_.front, matched());
  ASSERT_EQ(rays.size(), 1u);
  EXPECT_EQ(rays[0].point_index, 2u);
  // While a pose is verified, other matches have rays of their own, again and again.
  for (const uint32_t point : {7u, 8u}) {
    matched().room()[0] = {lifted, point, 10, 40};
    matched().assign(1, parts_.front, parts_.search.map(0));
    const Span<const Match> others = parts_.search.raysOf(parts_.front, matched(), rays);
    ASSERT_EQ(others.size(), 1u);
    EXPECT_EQ(others[0].point_index, point);
    EXPECT_EQ(rays[0].point_index, 2u);
  }
}

TEST_F(SearchTest, OthersAreTheMatchesOfKeypointsThatAreNotTaken) {
  parts_.see(0);
  const auto question = parts_.askAll();
  parts_.search.matchEverywhere(question, parts_.front.keypointCount(), {}, &matched(), &parts_.work);
  std::vector<Match> all(matched().matches().begin(), matched().matches().end()), taken, others;
  for (size_t i = 0; i < all.size(); ++i) (i % 3 ? taken : others).push_back(all[i]);
  parts_.search.matchOthers(question, parts_.front.keypointCount(), {taken.data(), taken.size()}, {}, &matched(),
                            &parts_.work);
  ASSERT_EQ(matched().matches().size(), others.size());
  for (size_t i = 0; i < others.size(); ++i) {
    EXPECT_EQ(matched().matches()[i].query, others[i].query);
    EXPECT_EQ(matched().matches()[i].point_index, others[i].point_index);
  }
  EXPECT_EQ(matched().all().size(), others.size());
}

TEST_F(SearchTest, MatchingTakesTimeByTheCallersClock) {
  int64_t now = 0;
  parts_.config.clock = {tick, &now};
  parts_.search.init(parts_.config);
  parts_.see(0);
  const auto question = parts_.askAll();
  EXPECT_EQ(parts_.work.match_ns, 1000u);
  parts_.search.matchEverywhere(question, 40, {}, &matched(), &parts_.work);
  EXPECT_EQ(parts_.work.match_ns, 2000u);
  parts_.search.matchNear(question, parts_.cameraFromMap(0), degrees(2), {}, {}, &matched(), &parts_.work);
  EXPECT_EQ(parts_.work.match_ns, 3000u);
}

}  // namespace
}  // namespace sphc
