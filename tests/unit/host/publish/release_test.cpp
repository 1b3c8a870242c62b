#include "host/publish/release.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "host/publish/map_writer.h"
#include "runtime/map/map_view.h"
#include "runtime/map/packed_direction.h"
#include "runtime/stages/features/extractor.h"
#include "tests/support/made_up_model.h"
#include "tests/support/refusal.h"
#include "tests/support/release_request.h"

namespace sphc::host {
namespace {

using test::releaseRequest;
using testing::HasSubstr;

constexpr double kEta = 1.0 / 3;

// Why it is refused.
std::string refusal(const PointModel &model, const ReleaseRequest &request) {
  return test::refusal([&] { makeRelease(model, request); });
}

// The next release of what the owner has.
NewRelease releaseAfter(const NewRelease &before, const PointModel &model) {
  return makeRelease(model, releaseRequest({before.place}));
}

// Direction and descriptor of each entry, in the order of the file.
std::vector<std::string> entriesOf(const std::vector<uint8_t> &file) {
  MapView view;
  EXPECT_EQ(MapView::open(file.data(), file.size(), kExtractorId, &view, nullptr), SPHC_OK);
  std::vector<std::string> entries;
  for (uint32_t i = 0; i < view.pointCount(); ++i)
    entries.push_back(std::string(reinterpret_cast<const char *>(&view.directions()[i]), 4) +
                      std::string(reinterpret_cast<const char *>(&view.descriptor(i)), kDescriptorBytes));
  return entries;
}

std::set<std::string> setOf(const std::vector<uint8_t> &file) {
  const std::vector<std::string> entries = entriesOf(file);
  return {entries.begin(), entries.end()};
}

std::set<std::string> descriptorsOf(const std::vector<uint8_t> &file) {
  std::set<std::string> names;
  for (const std::string &entry : entriesOf(file)) names.insert(entry.substr(4));
  return names;
}

bool contains(const std::set<std::string> &all, const std::set<std::string> &some) {
  return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

TEST(PackedDirections, WhatWasUnpackedIsPackedIntoTheSameBytes) {
  Random random(2);
  std::vector<Vector3> directions = {Vector3::UnitX(),
                                     -Vector3::UnitX(),
                                     Vector3::UnitY(),
                                     -Vector3::UnitZ(),
                                     Vector3(1, 1, 0).normalized(),
                                     Vector3(-1, 1, -1e-9).normalized()};
  for (int i = 0; i < 200000; ++i) directions.push_back(test::randomDirection(&random));
  for (int i = 0; i < 20000; ++i)  // along the fold
    directions.push_back((test::randomDirection(&random).cwiseProduct(Vector3(1, 1, 3e-5))).normalized());
  for (const Vector3 &direction : directions) {
    const PackedDirection packed = packDirection(direction);
    const Direction d = unpackDirection(packed);
    const PackedDirection again = packDirection(Eigen::Vector3f(d.x, d.y, d.z).cast<double>());
    ASSERT_TRUE(packed.u == again.u && packed.v == again.v) << direction.transpose();
  }
}

TEST(Release, TheFirstHasEveryPointAndRealOnesByEta) {
  const PointModel room = test::madeUpRoom(3000, 1);
  const NewRelease made = makeRelease(room, releaseRequest());
  EXPECT_EQ(made.place.number, 1u);
  EXPECT_EQ(made.place.releases.size(), 1u);
  EXPECT_EQ(made.summary.added, 3000u);
  EXPECT_FALSE(made.summary.is_update);
  EXPECT_EQ(setOf(made.file).size(), 3000u);
  Vector3 mean = Vector3::Zero();
  for (const ModelPoint &point : room.points) mean += point.position_m / 3000;
  EXPECT_LT((made.place.centre_m - mean).norm(), 1e-9);
  size_t real = 0;
  for (const PlacePoint &point : made.place.points) {
    const Direction d = unpackDirection(point.direction);
    const Vector3 truth = (point.seen.position_m - made.place.centre_m).normalized();
    EXPECT_EQ(point.real, (Eigen::Vector3f(d.x, d.y, d.z).cast<double>() - truth).norm() < 1e-4);
    real += point.real;
  }
  EXPECT_EQ(real, 1000u);
}

TEST(Release, TheSameRecordingAndKeyGiveTheSameBytes) {
  const PointModel room = test::madeUpRoom(1000, 1);
  const NewRelease made = makeRelease(room, releaseRequest());
  EXPECT_EQ(made.file, makeRelease(room, releaseRequest()).file);
  EXPECT_NE(made.file, makeRelease(room, releaseRequest({}, 2)).file);
  const NewRelease again = releaseAfter(made, room);
  EXPECT_TRUE(again.summary.is_same);
  EXPECT_EQ(again.file, made.file);
  EXPECT_EQ(again.place.releases.size(), 1u);
}

// Bits rot: an update must show what was published, or nothing.
TEST(Release, APlaceThatIsNotAsItWasPublishedIsRefused) {
  const PointModel room = test::madeUpRoom(1000, 1);
  const NewRelease made = makeRelease(room, releaseRequest());
  NewRelease turned = made, other = made, moved = made;
  ++turned.place.points[500].direction.u;
  other.place.points[999].descriptor.bytes[7] ^= 0xFF;
  moved.place.points[3].seen.position_m.x() += 1e-6;  // never published
  for (const NewRelease *damaged : {&turned, &other})
    EXPECT_EQ(refusal(room, releaseRequest({damaged->place})),
              "the ledger is damaged: what it holds of place 1 is not what its release 1 showed; take the backup");
  EXPECT_EQ(releaseAfter(moved, room).file, made.file);
}

// Whoever lost a first release makes it again with its key, years later: what is drawn under a key stays for ever.
TEST(Release, WhatAKeyDrawsNeverChanges) {
  const PointModel room = test::madeUpRoom(100, 1);
  const NewRelease made = makeRelease(room, releaseRequest());
  std::vector<ptrdiff_t> first;  // the points that were published first, which gaussian leaves real
  for (size_t i = 0; i < 6; ++i) {
    const Descriptor &descriptor = made.place.points[i].seen.descriptor;
    const auto point = std::find_if(room.points.begin(), room.points.end(), [&](const ModelPoint &p) {
      return std::equal(p.descriptor.bytes, p.descriptor.bytes + kDescriptorBytes, descriptor.bytes);
    });
    first.push_back(point - room.points.begin());
    EXPECT_TRUE(made.place.points[i].real);
  }
  EXPECT_THAT(first, testing::ElementsAre(42, 10, 77, 62, 4, 13));
}

TEST(Release, AnUpdateKeepsAllThatWasPublished) {
  const PointModel room = test::madeUpRoom(3000, 1);
  const NewRelease first = makeRelease(room, releaseRequest());
  // Triangulated anew in another world, a tenth of it gone, a tenth new.
  const PointModel more = test::seenLater(room, 2700, test::madeUpRoom(300, 9, {10.5, -4, 2}));
  const NewRelease second = releaseAfter(first, more);
  EXPECT_TRUE(second.summary.is_update);
  EXPECT_EQ(second.summary.known, 2700u);
  EXPECT_EQ(second.summary.added, 300u);
  EXPECT_EQ(second.place.centre_m, first.place.centre_m);
  EXPECT_EQ(second.place.releases.size(), 2u);
  EXPECT_NE(second.place.releases[0].map_id, second.place.releases[1].map_id);
  const auto before = setOf(first.file), after = setOf(second.file);
  EXPECT_TRUE(contains(after, before));  // byte for byte, and those that vanished too
  EXPECT_EQ(after.size(), 3300u);
  const auto fresh_real = std::count_if(second.place.points.begin() + 3000, second.place.points.end(),
                                        [](const PlacePoint &point) { return point.real; });
  EXPECT_EQ(fresh_real, 100);
  for (size_t i = 3000; i < 3300; ++i) EXPECT_EQ(second.place.points[i].release, 2u);
}

TEST(Release, NewPointsAreSeenFromTheOldCentreInTheOldWorld) {
  const PointModel room = test::madeUpRoom(2000, 1), corner = test::madeUpRoom(200, 9, {10.5, -4, 2});
  const NewRelease first = makeRelease(room, releaseRequest());
  const NewRelease second =
      releaseAfter(first, test::seenAgain(test::joined(room, corner), 3, test::otherWorld(), 0, 0));
  for (size_t i = 2000; i < 2200; ++i) {
    const PlacePoint &point = second.place.points[i];
    const auto same = std::find_if(corner.points.begin(), corner.points.end(), [&](const ModelPoint &p) {
      return std::equal(p.descriptor.bytes, p.descriptor.bytes + kDescriptorBytes, point.seen.descriptor.bytes);
    });
    ASSERT_NE(same, corner.points.end());
    EXPECT_LT((same->position_m - point.seen.position_m).norm(), 1e-6);
  }
}

TEST(Release, EntriesKeepTheirOrder) {
  const PointModel room = test::madeUpRoom(500, 1);
  const NewRelease first = makeRelease(room, releaseRequest());
  const NewRelease second = releaseAfter(first, test::joined(room, test::madeUpRoom(100, 9)));
  std::vector<std::string> before, after;
  for (const SpherePoint &p : publishedCloud(first.place, {1}).points)
    before.emplace_back(p.descriptor.bytes, p.descriptor.bytes + kDescriptorBytes);
  const std::set<std::string> known(before.begin(), before.end());
  for (const SpherePoint &p : publishedCloud(second.place, {1}).points) {
    std::string name(p.descriptor.bytes, p.descriptor.bytes + kDescriptorBytes);
    if (known.count(name)) after.push_back(std::move(name));
  }
  EXPECT_EQ(before, after);
}

TEST(Release, DoubtfulPointsAreLeftOut) {
  const PointModel room = test::madeUpRoom(2000, 1);
  const NewRelease first = makeRelease(test::part(room, 0, 1500), releaseRequest());
  const PointModel doubtful = test::seenAgain(test::part(room, 0, 200), 3, {}, 0.005, 26);
  const NewRelease second = releaseAfter(first, test::joined(doubtful, test::part(room, 200, 1800)));
  EXPECT_EQ(second.summary.known, 1300u);
  EXPECT_EQ(second.summary.ambiguous, 200u);
  EXPECT_EQ(second.summary.added, 500u);
}

TEST(Release, AFewNewPointsWaitForMore) {
  const PointModel room = test::madeUpRoom(1100, 1);
  const NewRelease first = makeRelease(test::part(room, 0, 1000), releaseRequest());
  const NewRelease held = releaseAfter(first, test::part(room, 0, 1030));
  EXPECT_EQ(held.summary.held_back, 30u);
  EXPECT_TRUE(held.summary.is_same);
  EXPECT_EQ(held.file, first.file);
  EXPECT_EQ(releaseAfter(held, room).summary.added, 100u);
}

// An update cannot have another eta, so that is no cure.
TEST(Release, NewPointsOfWhichNotOneWouldBeRealWaitForMore) {
  const PointModel room = test::madeUpRoom(1200, 1);
  ReleaseRequest request = releaseRequest();
  request.eta = 0.01;
  const NewRelease first = makeRelease(test::part(room, 0, 1000), request);
  const NewRelease held = releaseAfter(first, test::part(room, 0, 1090));
  EXPECT_EQ(held.summary.held_back, 90u);
  EXPECT_EQ(held.file, first.file);
  EXPECT_EQ(releaseAfter(held, room).summary.added, 200u);
}

TEST(Release, NearDuplicatesAreMergedFirst) {
  const PointModel room = test::madeUpRoom(500, 1);
  const NewRelease made = makeRelease(test::joined(room, test::seenAgain(room, 2)), releaseRequest());
  EXPECT_EQ(made.summary.near_duplicates, 500u);
  EXPECT_EQ(setOf(made.file).size(), 500u);
}

TEST(Release, AnotherRoomIsAnotherPlaceAndSharesNoPoint) {
  const PointModel room = test::madeUpRoom(2000, 1);
  const NewRelease first = makeRelease(room, releaseRequest());
  const PointModel next = test::seenLater(room, 400, test::madeUpRoom(1600, 5, {14, -4, 2}));
  const NewRelease second = releaseAfter(first, next);
  EXPECT_FALSE(second.summary.is_update);
  EXPECT_EQ(second.place.number, 2u);
  EXPECT_EQ(second.summary.elsewhere, 400u);
  EXPECT_EQ(second.summary.added, 1600u);
  // A third recording shows both: it belongs to the one, and what the other has is left out.
  const PointModel both =
      test::joined(test::part(room, 0, 300), test::seenAgain(next, 4, test::otherWorld().inverse()));
  const NewRelease third = makeRelease(both, releaseRequest({first.place, second.place}));
  EXPECT_TRUE(third.summary.is_update);
  EXPECT_EQ(third.place.number, 2u);
  EXPECT_EQ(third.summary.added, 0u);
}

TEST(Release, UnlessToldOtherwiseANewPlaceHasTheDefaultFakesAndAKnownOneItsOwn) {
  const PointModel room = test::madeUpRoom(1000, 1);
  ReleaseRequest unsaid = releaseRequest();
  unsaid.strategy = nullptr;
  EXPECT_EQ(makeRelease(room, unsaid).place.strategy, kDefaultFakes);

  unsaid.own = {makeRelease(room, releaseRequest()).place};
  const PointModel larger = test::madeUpRoom(1500, 1);
  const NewRelease update = makeRelease(larger, unsaid);
  EXPECT_TRUE(update.summary.is_update);
  EXPECT_EQ(update.place.strategy, "gaussian");
  EXPECT_GT(update.summary.added, 0u);
}

TEST(Release, AnUpdateKeepsWhatShapedTheFakes) {
  const PointModel room = test::madeUpRoom(1000, 1), larger = test::madeUpRoom(1500, 1);
  const auto wide = patchworkFakes(20), usual = patchworkFakes();
  ReleaseRequest request = releaseRequest();
  request.strategy = wide.get();
  request.own = {makeRelease(room, request).place};
  EXPECT_EQ(request.own[0].fake_option, 20);
  const std::vector<uint8_t> said = makeRelease(larger, request).file;
  request.strategy = nullptr;
  EXPECT_EQ(makeRelease(larger, request).file, said);
  request.strategy = usual.get();
  EXPECT_THAT(refusal(larger, request), HasSubstr("fakes 'patchwork' of 20, not of 8"));
  // Of a ledger that did not keep it, the owner knows best.
  request.own[0].fake_option = 0;
  EXPECT_EQ(refusal(larger, request), "");
  EXPECT_NE(makeRelease(larger, request).file, said);
}

TEST(Release, ASecondIndependentReleaseIsRefused) {
  const PointModel room = test::madeUpRoom(1000, 1);
  const NewRelease first = makeRelease(room, releaseRequest());
  ReleaseRequest other_eta = releaseRequest({first.place});
  other_eta.eta = 0.5;
  EXPECT_THAT(refusal(room, other_eta), HasSubstr("eta 0.3333"));
  other_eta.eta = kEta;
  EXPECT_EQ(refusal(room, other_eta), "");

  ReleaseRequest other_fakes = releaseRequest({first.place});
  other_fakes.own[0].strategy = "permuted";
  EXPECT_THAT(refusal(room, other_fakes), HasSubstr("'permuted', not 'gaussian'"));

  ReleaseRequest other_ledger = releaseRequest({}, 2);
  other_ledger.foreign = {first.place};
  EXPECT_THAT(refusal(test::seenAgain(room, 2, test::otherWorld()), other_ledger), HasSubstr("--i-understand"));
  EXPECT_EQ(refusal(test::madeUpRoom(1000, 6), other_ledger), "");
}

// Of a wrong unit of depth that was put right: the directions are the same, and would have other fakes.
TEST(Release, ASecondReleaseAtAnotherScaleIsRefused) {
  const PointModel room = test::madeUpRoom(1000, 1);
  const NewRelease first = makeRelease(room, releaseRequest());
  PointModel larger = test::seenAgain(room, 2, test::otherWorld());
  for (ModelPoint &point : larger.points) point.position_m *= 5;
  EXPECT_THAT(refusal(larger, releaseRequest({first.place})), HasSubstr("5 times as large"));
  ReleaseRequest of_others = releaseRequest({}, 2);
  of_others.foreign = {first.place};
  of_others.new_place = true;
  EXPECT_THAT(refusal(larger, of_others), HasSubstr("5 times as large"));
  of_others.understood = true;
  EXPECT_EQ(refusal(larger, of_others), "");
}

TEST(Release, APlaceKeepsItsBand) {
  PointModel room = test::madeUpRoom(1000, 1);
  room.band = SPHC_BAND_INFRARED;
  const NewRelease first = makeRelease(room, releaseRequest());
  EXPECT_EQ(first.place.band, SPHC_BAND_INFRARED);
  MapView view;
  ASSERT_EQ(MapView::open(first.file.data(), first.file.size(), kExtractorId, &view, nullptr), SPHC_OK);
  EXPECT_EQ(view.band(), SPHC_BAND_INFRARED);
  EXPECT_EQ(refusal(room, releaseRequest({first.place})), "");
  room.band = SPHC_BAND_VISIBLE;
  ReleaseRequest request = releaseRequest({first.place});
  EXPECT_THAT(refusal(room, request), AllOf(HasSubstr("--band"), HasSubstr("say --i-understand")));
  request.understood = true;
  const NewRelease put_right = makeRelease(room, request);
  EXPECT_EQ(put_right.place.number, 2u);
  EXPECT_EQ(makeRelease(room, releaseRequest({first.place, put_right.place})).place.number, 2u);
}

TEST(Release, ANewPlaceHasOnlyWhatWasNeverPublished) {
  const PointModel room = test::madeUpRoom(1500, 1);
  const NewRelease first = makeRelease(test::part(room, 0, 1000), releaseRequest());
  ReleaseRequest anew = releaseRequest({first.place}, 2);
  anew.eta = 0.5;
  anew.new_place = true;
  const NewRelease second = makeRelease(room, anew);
  EXPECT_EQ(second.place.number, 2u);
  EXPECT_EQ(second.summary.added, 500u);
  for (const std::string &name : descriptorsOf(second.file)) EXPECT_EQ(descriptorsOf(first.file).count(name), 0u);
  EXPECT_THAT(refusal(test::part(room, 0, 1000), anew),
              AllOf(HasSubstr("of 1000 points 1000 are published already"), HasSubstr("leave --new-place out"),
                    HasSubstr("say --i-understand")));
  anew.own = {};
  EXPECT_THAT(refusal(test::part(room, 0, 20), anew), HasSubstr("record more frames")) << "nothing was published";
}

TEST(Release, WhoUnderstandsMayPublishTwice) {
  const PointModel room = test::madeUpRoom(1000, 1);
  const NewRelease first = makeRelease(room, releaseRequest());
  ReleaseRequest again = releaseRequest({first.place});
  again.understood = true;
  const NewRelease second = makeRelease(room, again);
  EXPECT_EQ(second.place.number, 2u);
  EXPECT_EQ(second.summary.added, 1000u);
  EXPECT_NE(setOf(second.file), setOf(first.file));
  // What was given up is not updated: the later map is what the place has now.
  const PointModel later = test::seenLater(room, 900, test::madeUpRoom(200, 9, {10.5, -4, 2}));
  const NewRelease third = makeRelease(later, releaseRequest({first.place, second.place}));
  EXPECT_TRUE(third.summary.is_update);
  EXPECT_EQ(third.place.number, 2u);
  EXPECT_EQ(third.summary.added, 200u);
  EXPECT_TRUE(contains(setOf(third.file), setOf(second.file)));
}

// The map that was given up has more of the place than the one that was published anew.
TEST(Release, AMapThatWasGivenUpIsNotUpdatedThoughItKnowsMore) {
  const PointModel room = test::madeUpRoom(1000, 1);
  const NewRelease first = makeRelease(room, releaseRequest());
  ReleaseRequest again = releaseRequest({first.place});
  again.understood = true;
  const NewRelease second = makeRelease(test::part(room, 0, 700), again);
  const NewRelease third =
      makeRelease(test::seenAgain(room, 3, test::otherWorld()), releaseRequest({first.place, second.place}));
  EXPECT_EQ(third.place.number, 2u);
  EXPECT_EQ(third.summary.elsewhere, 300u) << "what the other map alone has stays there";
}

TEST(Release, OfTwoPlacesThatARecordingShowsTheOneItShowsMoreOfIsUpdated) {
  const PointModel room = test::madeUpRoom(1000, 1), next = test::madeUpRoom(1000, 5, {14, -4, 2});
  const NewRelease first = makeRelease(room, releaseRequest());
  const NewRelease second = releaseAfter(first, next);
  EXPECT_EQ(second.place.number, 2u);
  const PointModel both = test::joined(test::part(room, 0, 600), test::part(next, 0, 400));
  EXPECT_EQ(makeRelease(both, releaseRequest({first.place, second.place})).place.number, 1u);
}

TEST(Release, BadModelsAreExplained) {
  PointModel room = test::madeUpRoom(200, 1);
  EXPECT_THAT(refusal(test::part(room, 0, 20), releaseRequest()), HasSubstr("too few"));
  ReleaseRequest bad_eta = releaseRequest();
  for (double eta : {0.0, -1.0, 1.01, std::nan("")}) {
    bad_eta.eta = eta;
    EXPECT_THAT(refusal(room, bad_eta), HasSubstr("(0, 1]"));
  }
  for (double far : {1e7, std::nan(""), HUGE_VAL}) {
    room.points[7].position_m.x() = far;
    EXPECT_THAT(refusal(room, releaseRequest()), HasSubstr("nowhere near"));
  }
  room.points[7].position_m.x() = 0;
  for (double unknown : {1e6, -1.0, std::nan(""), HUGE_VAL}) {
    room.points[7].sigma_m = unknown;
    EXPECT_THAT(refusal(room, releaseRequest()), HasSubstr("nobody knows where it is"));
  }
}

}  // namespace
}  // namespace sphc::host
