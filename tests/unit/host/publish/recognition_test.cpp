#include "host/publish/recognition.h"

#include <gtest/gtest.h>

#include "tests/support/made_up_model.h"

namespace sphc::host {
namespace {

Place placeOf(const PointModel &model) {
  Place place;
  for (const ModelPoint &point : model.points) place.points.push_back({point, {1, 1}, point.descriptor, true, 1});
  return place;
}

TEST(Recognition, FindsTheFrameAndThePointsWhateverTheWorld) {
  const PointModel room = test::madeUpRoom(2000, 1);
  const Rigid other_from_world = test::otherWorld();
  const PointModel again = test::joined(test::seenAgain(room, 2, other_from_world),
                                        test::seenAgain(test::madeUpRoom(500, 3), 4, other_from_world));
  const Recognition r = recognize(placeOf(room), again);
  ASSERT_EQ(r.place_from_model.size(), 1u);
  const Similarity &place_from_model = r.place_from_model[0];
  EXPECT_NEAR(place_from_model.scale, 1, 1e-3);
  for (const ModelPoint &point : room.points)
    EXPECT_LT((place_from_model * (other_from_world * point.position_m) - point.position_m).norm(), 2e-3);
  EXPECT_EQ(r.known, 2000u);
  for (size_t i = 0; i < 2500; ++i) EXPECT_EQ(r.identities[i], i < 2000 ? Identity::kKnown : Identity::kNew) << i;
}

TEST(Recognition, AModelThatIsALittleTooLarge) {
  const PointModel room = test::madeUpRoom(1000, 1);
  PointModel larger = room;
  for (ModelPoint &point : larger.points) point.position_m *= 1.05;
  const Recognition r = recognize(placeOf(room), larger);
  ASSERT_FALSE(r.place_from_model.empty());
  EXPECT_NEAR(r.place_from_model[0].scale, 1 / 1.05, 1e-6);
  EXPECT_EQ(r.known, 1000u);
}

TEST(Recognition, AModelInAnotherUnitIsToldWithIt) {
  const PointModel room = test::madeUpRoom(1000, 1);
  for (const double times : {0.001, 0.2, 3.0, 5.0}) {
    PointModel again = test::seenAgain(room, 2, test::otherWorld());
    for (ModelPoint &point : again.points) {
      point.position_m *= times;
      point.sigma_m *= times;
    }
    EXPECT_EQ(recognize(placeOf(room), again).known, 0u);
    EXPECT_NEAR(scaleToPlace(placeOf(room), again, 900) * times, 1, 0.01) << times;
  }
  EXPECT_EQ(scaleToPlace(placeOf(room), test::seenAgain(room, 2), 300), 0);
  EXPECT_EQ(scaleToPlace(placeOf(room), test::madeUpRoom(1000, 2), 300), 0);
}

TEST(Recognition, PlacesThatSharePointsAreTold) {
  const PointModel room = test::madeUpRoom(1000, 1);
  const Place place = placeOf(test::part(room, 0, 600));
  PointModel part = test::seenAgain(test::part(room, 500, 500), 2, test::otherWorld());
  EXPECT_TRUE(shareAPoint(place, placeOf(part)));
  for (ModelPoint &point : part.points) point.position_m *= 5;
  EXPECT_TRUE(shareAPoint(place, placeOf(part)));
  EXPECT_FALSE(shareAPoint(place, placeOf(test::part(room, 600, 400)))) << "of one room, and what was left over";
  EXPECT_FALSE(shareAPoint(place, placeOf(test::madeUpRoom(1000, 2))));
}

TEST(Recognition, ThePlacesFrameIsToldFromAnother) {
  const PointModel room = test::madeUpRoom(1000, 1);
  EXPECT_EQ(knownInPlaceFrame(placeOf(room), test::seenAgain(room, 2)), 1000u);
  EXPECT_EQ(knownInPlaceFrame(placeOf(room), test::seenAgain(room, 2, test::otherWorld())), 0u);
}

TEST(Recognition, AnotherRoomIsAnother) {
  const Recognition r = recognize(placeOf(test::madeUpRoom(2000, 1)), test::madeUpRoom(2000, 2));
  EXPECT_TRUE(r.place_from_model.empty());
  EXPECT_EQ(r.known, 0u);
}

TEST(Recognition, AFewPercentInCommonAreEnough) {
  const PointModel room = test::madeUpRoom(2000, 1);
  const PointModel next =
      test::joined(test::madeUpRoom(1900, 2), test::seenAgain(test::part(room, 0, 60), 5, test::otherWorld()));
  EXPECT_EQ(recognize(placeOf(room), next).known, 60u);
}

TEST(Recognition, ThingsThatWereMovedAreKnown) {
  const PointModel room = test::madeUpRoom(2000, 1);
  Random random(5);
  const Rigid moved = {test::randomRotation(&random), {1, 0.5, 0}};
  const PointModel again = test::joined(test::seenAgain(test::part(room, 0, 1800), 6),
                                        test::seenAgain(test::part(room, 1800, 200), 7, moved));
  const Recognition r = recognize(placeOf(room), again);
  EXPECT_EQ(r.place_from_model.size(), 2u);
  EXPECT_EQ(r.known, 2000u);
}

TEST(Recognition, NearButOnlySomewhatAlikeIsAmbiguous) {
  const PointModel room = test::madeUpRoom(2000, 1);
  const PointModel again = test::joined(test::seenAgain(test::part(room, 0, 1000), 6),
                                        test::seenAgain(test::part(room, 1000, 1000), 7, {}, 0.005, 26));
  const Recognition r = recognize(placeOf(room), again);
  EXPECT_EQ(r.known, 1000u);
  for (size_t i = 1000; i < 2000; ++i) EXPECT_EQ(r.identities[i], Identity::kAmbiguous);
}

TEST(Recognition, ToleranceGrowsWithSigma) {
  const PointModel room = test::madeUpRoom(500, 1);
  for (double sigma_m : {0.005, 0.04}) {
    PointModel again = room;
    for (size_t i = 0; i < 10; ++i) {
      again.points[i].position_m += Vector3(0.12, 0, 0);
      again.points[i].sigma_m = sigma_m;
    }
    EXPECT_EQ(recognize(placeOf(room), again).known, sigma_m > 0.03 ? 500u : 490u);
  }
}

}  // namespace
}  // namespace sphc::host
