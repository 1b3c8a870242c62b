#include "host/audit/attack/photos.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/audit/score/release_scores.h"
#include "tests/unit/host/audit/made_up_releases.h"

namespace sphc::host {
namespace {

class Photos : public testing::Test {
 protected:
  // What a camera sees of some of the room's points, described anew; by how much descriptors change, and where it
  // is.
  std::vector<OwnPoint> photo(const PointModel &place) const {
    std::vector<OwnPoint> seen;
    for (const ModelPoint &point : test::seenAgain(test::part(place, 0, 600), 2).points)
      seen.push_back({point.position_m - release.place.centre_m, point.descriptor});
    return seen;
  }

  const PointModel room = test::madeUpRoom(6000, 1);
  const test::MadeUpRelease release = test::released(room, 1, 1.0 / 3, {}, patchworkFakes().get());
};

TEST_F(Photos, MarkRealEntriesAndInTheMirrorFakes) {
  const Exposure plain = scoreEntries(markedBy(release.map, {photo(room)}, Photo::kAsItIs), release.truth);
  const Exposure mirrored = scoreEntries(markedBy(release.map, {photo(room)}, Photo::kMirrored), release.truth);
  EXPECT_GT(plain.believed, 30u);
  EXPECT_EQ(plain.precision(), 1);
  EXPECT_GT(mirrored.believed, 60u);
  EXPECT_EQ(mirrored.precision(), 0);
}

TEST_F(Photos, OfAnotherPlaceMarkNothing) {
  const std::vector<OwnPoint> strange = photo(test::madeUpRoom(6000, 9));
  for (const Photo how : {Photo::kAsItIs, Photo::kMirrored})
    EXPECT_THAT(markedBy(release.map, {strange}, how), testing::IsEmpty());
}

TEST_F(Photos, APairWithoutCompanyIsNotBelieved) {
  std::vector<OwnPoint> apart = photo(room);
  for (size_t i = 0; i < apart.size(); ++i) apart[i].position_m = Vector3(static_cast<double>(i), 0, 0);
  EXPECT_THAT(matchesInCompany(release.map, apart, Photo::kAsItIs), testing::IsEmpty());
}

TEST_F(Photos, EachEntryIsMarkedOnce) {
  const auto once = markedBy(release.map, {photo(room)}, Photo::kAsItIs);
  EXPECT_EQ(markedBy(release.map, {photo(room), photo(room)}, Photo::kAsItIs), once);
}

}  // namespace
}  // namespace sphc::host
