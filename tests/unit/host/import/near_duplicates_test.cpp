#include "host/import/near_duplicates.h"

#include <gtest/gtest.h>

#include "tests/support/made_up_model.h"

namespace sphc::host {
namespace {

constexpr NearDuplicateRule kRule = {0.06, 260};

TEST(NearDuplicates, NearAndAlikeBecomeTheOneThatMostFramesSaw) {
  Random random(3);
  PointModel model = test::madeUpRoom(1, 1);
  ModelPoint duplicate = model.points[0];
  duplicate.position_m += Vector3(0.03, 0.03, 0.03);
  duplicate.descriptor = test::changed(duplicate.descriptor, 20, &random);
  duplicate.observations = model.points[0].observations + 1;
  model.points.push_back(duplicate);
  const PointModel merged = withoutNearDuplicates(model, kRule);
  ASSERT_EQ(merged.points.size(), 1u);
  EXPECT_EQ(merged.points[0].observations, duplicate.observations);
  EXPECT_EQ(merged.points[0].position_m, duplicate.position_m);
}

TEST(NearDuplicates, NearAloneOrAlikeAloneIsNotEnough) {
  Random random(4);
  PointModel model = test::madeUpRoom(1, 1);
  ModelPoint near = model.points[0], alike = model.points[0];
  near.descriptor = test::randomDescriptor(&random);
  alike.position_m += Vector3(0.05, 0.05, 0);  // 7 cm
  model.points.push_back(near);
  model.points.push_back(alike);
  EXPECT_EQ(withoutNearDuplicates(model, kRule).points.size(), 3u);
}

TEST(NearDuplicates, TheBandStays) {
  PointModel model;
  model.band = SPHC_BAND_INFRARED;
  EXPECT_EQ(withoutNearDuplicates(model, kRule).band, SPHC_BAND_INFRARED);
}

TEST(NearDuplicates, AcrossTheWallsOfTheGrid) {
  for (double offset : {-0.059, 0.059})
    for (double x : {-1e-9, 0.0, 0.06, 0.12 - 1e-12}) {
      PointModel model = test::madeUpRoom(1, 1);
      model.points[0].position_m = {x, x, x};
      model.points.push_back(model.points[0]);
      model.points[1].position_m.y() += offset;
      EXPECT_EQ(withoutNearDuplicates(model, kRule).points.size(), 1u) << x << " " << offset;
    }
}

}  // namespace
}  // namespace sphc::host
