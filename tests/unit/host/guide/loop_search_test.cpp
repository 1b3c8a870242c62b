#include "host/guide/loop_search.h"

#include <gtest/gtest.h>

#include "host/guide/places.h"
#include "host/mapping/frame_reader.h"
#include "made_up_wall.h"

namespace sphc::host {
namespace {

constexpr int kPlacePx = 40, kPlacesOfWall = 20;
constexpr double kPlaceM = kPlacePx / kWallFocalPx * kWallM;

// Places along a wall, all but the last of one part, and a frame that follows the last.
class LoopSearchTest : public testing::Test {
 protected:
  // Every other place lies `off_m` higher than it was.
  void addPlaces(double off_m) {
    for (int i = 0; i < kPlacesOfWall; ++i) {
      GuidePlace place;
      place.part_from_camera.translation_m = {i * kPlaceM, i % 2 * off_m, 0};
      places_.add(frameAt(i * kPlacePx), place);
    }
    GuidePlace apart;
    apart.part = 1;
    here_ = frameAt(8 * kPlacePx + 10);
    last_ = places_.add(here_, apart);
  }
  WalkFrame frameAt(int x_px) { return reader_.describe(wall_.view(x_px, 1)); }
  std::optional<FoundLoop> look() { return search_.look({&here_, last_, Rigid()}); }

  MadeUpWall wall_{1};
  FrameReader reader_{wallRig(), {}};
  Places places_{1000};
  LoopSearch search_{&places_};
  WalkFrame here_;
  uint32_t last_ = 0;
};

TEST_F(LoopSearchTest, TwoPairsOfViewsMakeALoop) {
  addPlaces(0);
  EXPECT_FALSE(look());  // one pair alone
  std::optional<FoundLoop> found = look();
  ASSERT_TRUE(found);
  const double there_px = kPlacePx * static_cast<double>(found->place), here_px = 8 * kPlacePx + 10;
  EXPECT_NEAR(found->camera_from_place.translation_m.x(), (there_px - here_px) / kWallFocalPx * kWallM, 0.02);
}

TEST_F(LoopSearchTest, PairsThatContradictEachOtherMakeNone) {
  addPlaces(0.3);
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(look()) << i;
}

TEST_F(LoopSearchTest, NeighboursInTimeAreNoLoop) {
  addPlaces(0);
  places_.join(1, 0, Rigid());
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(look()) << i;
}

TEST(PlacesTest, PartsAreJoinedByATransform) {
  Places places(10);
  for (const uint32_t part : {places.newPart(), places.newPart(), 1u}) {
    GuidePlace place;
    place.part = part;
    places.add({}, place);
  }
  EXPECT_EQ(places.partCount(), 2u);
  EXPECT_EQ(places.largestPart(), 1u);
  Rigid shift;
  shift.translation_m = {1, 2, 3};
  places.join(1, 0, shift);
  EXPECT_EQ(places.partCount(), 1u);
  EXPECT_EQ(places.sizeOf(0), 3u);
  EXPECT_EQ(places[2].part_from_camera.translation_m, Vector3(1, 2, 3));
  EXPECT_EQ(places[0].part_from_camera.translation_m, Vector3(0, 0, 0));
}

}  // namespace
}  // namespace sphc::host
