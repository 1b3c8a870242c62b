#include "host/audit/attack/presence.h"

#include <gtest/gtest.h>

#include "host/audit/score/auc.h"
#include "tests/unit/host/audit/made_up_releases.h"

namespace sphc::host {
namespace {

// A known limit: descriptors say what is in the map, whatever the directions.
TEST(Presence, APictureOfAnObjectTellsWhetherItIsThere) {
  const PointModel room = test::madeUpRoom(2000, 1), elsewhere = test::madeUpRoom(400, 2);
  const Published map = test::released(room, 1, 1.0 / 3).map;
  std::vector<double> scores;
  std::vector<bool> present;
  Random random(4);
  for (size_t object = 0; object < 20; ++object)
    for (const PointModel *where : {&room, &elsewhere}) {
      std::vector<Descriptor> crop;
      for (size_t i = 0; i < 20; ++i)
        crop.push_back(test::changed(where->points[20 * object + i].descriptor, 30, &random));
      scores.push_back(presenceScore(map, crop));
      present.push_back(where == &room);
    }
  EXPECT_GT(areaUnderCurve(scores, present).value, 0.99);
  EXPECT_EQ(presenceScore(map, {}), 0);
}

// Patchwork publishes the mirror image of every descriptor that it removes.
TEST(Presence, WhatWasRemovedIsFoundInTheMirror) {
  const test::MadeUpRelease release =
      test::released(test::madeUpRoom(2000, 1), 1, 1.0 / 3, {}, patchworkFakes().get());
  std::vector<Descriptor> removed;
  for (const PlacePoint &point : release.place.points)
    if (!point.real) removed.push_back(point.seen.descriptor);
  ASSERT_GT(removed.size(), 1000u);
  removed.resize(20);
  EXPECT_EQ(presenceScore(release.map, removed), 0);
  EXPECT_EQ(presenceScoreMirroredToo(release.map, removed), 1);
}

}  // namespace
}  // namespace sphc::host
