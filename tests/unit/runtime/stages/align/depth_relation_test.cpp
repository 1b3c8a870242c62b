#include "runtime/stages/align/depth_relation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "runtime/base/random.h"

namespace sphc {
namespace {

constexpr double kMidM = 1.5, kNoiseM = 0.005;

// What the second sensor says of a point at z_m, if true = said + 0.02 + 0.01 (said - mid).
double saidOf(double z_m) { return (z_m - 0.02 + 0.01 * kMidM) / 1.01; }

double depthM(Random *random) { return 0.5 + 0.01 * random->below(300); }

void teach(uint32_t frames, DepthRelation *relation) {
  Random random(3);
  for (uint32_t f = 0; f < frames; ++f) {
    relation->nextFrame();
    for (int i = 0; i < 100; ++i) {
      const double z_m = depthM(&random), noise_m = kNoiseM * (0.01 * random.below(201) - 1);
      relation->learn({z_m + noise_m, kNoiseM}, {saidOf(z_m), kNoiseM});
    }
  }
}

TEST(DepthRelation, SaysWhatTheFirstWouldHaveMeasured) {
  DepthRelation relation;
  relation.init(kMidM, {0.03, 0.03});
  const DepthRelation::Measured before = relation.asFirst({2.0, kNoiseM});
  EXPECT_EQ(before.z_m, 2.0);
  EXPECT_GT(before.sigma_m, 0.03);
  teach(20, &relation);
  for (const double z_m : {0.6, 1.5, 3.2}) {
    const DepthRelation::Measured after = relation.asFirst({saidOf(z_m), kNoiseM});
    EXPECT_NEAR(after.z_m, z_m, 0.002) << z_m;
    EXPECT_LT(after.sigma_m, 1.5 * kNoiseM) << z_m;
    EXPECT_GE(after.sigma_m, kNoiseM) << z_m;
  }
}

TEST(DepthRelation, IsNotMovedByOtherSurfaces) {
  DepthRelation relation;
  relation.init(kMidM, {0.03, 0.03});
  relation.learn({2.5, kNoiseM}, {2.0, kNoiseM});
  EXPECT_EQ(relation.asFirst({2.0, kNoiseM}).z_m, 2.0);
}

TEST(DepthRelation, OfSensorsThatMeasureAlikeNothingIsLearnt) {
  DepthRelation relation;
  relation.init(kMidM, {0, 0});
  teach(5, &relation);
  EXPECT_EQ(relation.asFirst({2.0, kNoiseM}).z_m, 2.0);
  EXPECT_EQ(relation.asFirst({2.0, kNoiseM}).sigma_m, kNoiseM);
}

TEST(DepthRelation, ForgetsWithTime) {
  DepthRelation relation;
  relation.init(kMidM, {0.03, 0.03});
  teach(20, &relation);
  const double fresh_m = relation.asFirst({2.0, kNoiseM}).sigma_m;
  for (int i = 0; i < 10000; ++i) relation.nextFrame();
  const double later_m = relation.asFirst({2.0, kNoiseM}).sigma_m;
  EXPECT_GT(later_m, 3 * fresh_m);
  EXPECT_LT(later_m, 0.04);
}

// Then the difference may be anything again that it might have been at first, at each depth.
TEST(DepthRelation, InTheEndAllIsForgotten) {
  DepthRelation relation;
  relation.init(kMidM, {0.03, 0.02});
  teach(20, &relation);
  for (int i = 0; i < 30000; ++i) relation.nextFrame();
  for (const double beyond_m : {-1.0, 0.0, 2.0})
    EXPECT_NEAR(relation.asFirst({kMidM + beyond_m, kNoiseM}).sigma_m, std::hypot(kNoiseM, 0.03, 0.02 * beyond_m),
                1e-6)
        << beyond_m;
}

// Points of one surface share their errors.
TEST(DepthRelation, ManyPointsOfAFrameAreNotAsManyWitnesses) {
  DepthRelation relation;
  relation.init(kMidM, {0.03, 0.03});
  teach(1, &relation);
  const double learnt_m = std::sqrt(std::pow(relation.asFirst({kMidM, kNoiseM}).sigma_m, 2) - kNoiseM * kNoiseM);
  EXPECT_GT(learnt_m, 2 * std::sqrt(2) * kNoiseM / 10) << "of 100 points, each with the noise of both";
}

}  // namespace
}  // namespace sphc
