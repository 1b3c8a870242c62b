#include "runtime/stages/pose/refine.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "tests/support/pose_cost.h"
#include "tests/support/pose_rows.h"
#include "tests/support/random_numbers.h"
#include "tests/support/sensor_world.h"
#include "tests/support/stepping_clock.h"

namespace sphc {
namespace {

constexpr double kScale2 = 8, kMidM = 2;

Rigid disturbed(const Rigid &pose, double rotation_rad, double translation_m, Random *random) {
  const Vector3 axis = test::randomDirection(random), shift = test::randomDirection(random);
  const Matrix3 turn = rotationFromVector(rotation_rad * axis);
  return {turn * pose.rotation, turn * pose.translation_m + translation_m * shift};
}

DepthCalibration biasPrior(double offset_sigma_m, double slope_sigma) {
  DepthCalibration prior;
  prior.mid_m = kMidM;
  prior.covariance.diagonal() << offset_sigma_m * offset_sigma_m, slope_sigma * slope_sigma;
  return prior;
}

// The rows of a world, with and without depth, and the task on them.
struct RefineProblem {
  explicit RefineProblem(const test::PoseWorld &of)
      : world(of), lifted(withDepth(true), simdPoseKernels()), planes(withDepth(false), simdPoseKernels()) {
    task.kernels = &simdPoseKernels();
    task.lifted = &lifted.rows;
    task.planes = &planes.rows;
    task.depth.mid_m = kMidM;
    task.scale2 = kScale2;
  }
  std::vector<Correspondence> withDepth(bool has) const {
    std::vector<Correspondence> out;
    for (const Correspondence &c : world.correspondences)
      if (c.lifted.hasDepth() == has) out.push_back(c);
    return out;
  }
  test::PoseWorld world;
  test::OwnedRows lifted, planes;
  RefineTask task = {};
};

test::PoseWorld exactWorld(uint64_t seed, double common_scale = 1) {
  test::PoseWorldOptions options;
  options.seed = seed;
  test::PoseWorld world = test::makePoseWorld(options);
  for (Correspondence &c : world.correspondences) {
    c.lifted.point_m *= common_scale;
    c.lifted.sideways_m *= common_scale;
    c.lifted.along_m *= common_scale;
  }
  return world;
}

// Without noise.
test::PoseWorld biasedWorld(uint64_t seed, double offset_m, double slope) {
  test::PoseWorld world = exactWorld(seed);
  for (Correspondence &c : world.correspondences) {
    const double z = c.lifted.point_m.z();
    c.lifted.point_m *= ((z - offset_m + slope * kMidM) / (1 + slope)) / z;
  }
  return world;
}

test::PoseWorld noisyWorld(uint64_t seed, double true_share = 1, double depthless_share = 0) {
  test::SensorWorldOptions options;
  options.seed = seed;
  options.true_share = true_share;
  options.depthless_share = depthless_share;
  return test::makeSensorWorld(options);
}

// To a third of the last step that it still looks at.
TEST(Refine, ConvergesToTheExactPose) {
  Random random(1);
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const RefineProblem p(exactWorld(seed));
    const Rigid start = disturbed(p.world.camera_from_map, 0.004, 0.008, &random);
    const Refinement refined = refinePose(p.task, start, 30);
    EXPECT_LT(test::rotationErrorRad(refined.camera_from_map, p.world.camera_from_map), 4e-5);
    EXPECT_LT(test::translationErrorM(refined.camera_from_map, p.world.camera_from_map), 4e-5);
    EXPECT_EQ(refined.bias.norm(), 0) << "known: not estimated";
  }
}

TEST(Refine, ImprovePoseComesNearInTwoSteps) {
  Random random(1);
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const RefineProblem p(exactWorld(seed));
    const Rigid start = disturbed(p.world.camera_from_map, 0.002, 0.004, &random);
    const Rigid pose = improvePose(p.task, start, 2);
    EXPECT_LT(test::translationErrorM(pose, p.world.camera_from_map),
              0.5 * test::translationErrorM(start, p.world.camera_from_map));
  }
}

// It stays with the pose that it has.
TEST(Refine, AfterItsDeadlineItTakesNoStep) {
  Random random(1);
  RefineProblem p(exactWorld(1));
  const Rigid start = disturbed(p.world.camera_from_map, 0.004, 0.008, &random);
  test::SteppingClock clock(1000);
  p.task.deadline = clock.deadline(0);
  const Refinement refined = refinePose(p.task, start, 30);
  EXPECT_EQ(refined.camera_from_map.translation_m, start.translation_m);
  EXPECT_EQ(refined.camera_from_map.rotation, start.rotation);
  EXPECT_GT((refined.information.topLeftCorner<6, 6>().diagonal().minCoeff()), 0)
      << "and says how well it is known";
}

// A residual at the scale of the loss has half the weight in the cost, and a quarter of what it tells of the pose.
TEST(Refine, WhatHardlyAgreesTellsLittle) {
  EXPECT_NEAR(finalInformation(kFinalScale2) / finalInformation(0), 0.25, 1e-12);
}

TEST(Refine, LetsGoOfFakes) {
  Random random(2);
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const RefineProblem p(noisyWorld(seed, 0.33));
    const Rigid start = disturbed(p.world.camera_from_map, 0.003, 0.005, &random);
    const Refinement refined = refinePose(p.task, start, 12);
    EXPECT_LT(test::rotationErrorRad(refined.camera_from_map, p.world.camera_from_map), 0.005);
    EXPECT_LT(test::translationErrorM(refined.camera_from_map, p.world.camera_from_map), 0.01);
  }
}

TEST(Refine, NeverRaisesTheCost) {
  Random random(3);
  RefineProblem p(noisyWorld(1, 0.5, 0.3));
  for (const DepthCalibration &depth : {biasPrior(0, 0), biasPrior(0.01, 0.02)}) {
    p.task.depth = depth;
    for (int i = 0; i < 30; ++i) {
      const Rigid start =
          disturbed(p.world.camera_from_map, 0.1 * random.uniform(), 0.2 * random.uniform(), &random);
      double last = refinePose(p.task, start, 0).cost;
      for (int iterations = 1; iterations < 8; ++iterations) {
        const double cost = refinePose(p.task, start, iterations).cost;
        EXPECT_LE(cost, last);
        last = cost;
      }
    }
  }
}

// Half the cost of what rows say, and of what priors say.
double halfLifted(const RefineProblem &p, const test::PoseCost &cost, const Vector8 &step) {
  double sum = 0;
  for (const Correspondence &c : p.withDepth(true)) sum += cost.lifted(c, step);
  return 0.5 * sum;
}
double halfPlanes(const RefineProblem &p, const test::PoseCost &cost, const Vector8 &step) {
  double sum = 0;
  for (const Correspondence &c : p.withDepth(false)) sum += cost.plane(c, step);
  return 0.5 * sum;
}
double halfPriors(const RefineProblem &p, const test::PoseCost &cost, const Vector8 &step) {
  const Vector3 up = cost.moved(step).rotation * p.task.prior->up_map, off = up - p.task.prior->up_camera;
  return 0.5 * (off.squaredNorm() / (p.task.prior->up_sigma_rad * p.task.prior->up_sigma_rad) +
                step.tail<2>().dot(p.task.depth.covariance.inverse() * step.tail<2>()));
}

double difference(const Matrix8 &a, const Matrix8 &b) {
  const Vector8 unit = b.diagonal().cwiseSqrt().cwiseInverse();
  return (unit.asDiagonal() * (a - b) * unit.asDiagonal()).cwiseAbs().maxCoeff();
}

// Depths and bearings of one world without noise.
test::PoseWorld exactMixedWorld() {
  test::SensorWorldOptions options;
  options.depthless_share = 0.4;
  options.pixel_sigma_px = options.depth_sigma_m = options.depth_sigma_per_m2 = options.map_sigma_m = 1e-7;
  test::PoseWorld world = test::makeSensorWorld(options);
  for (Correspondence &c : world.correspondences) {
    const bool has_depth = c.lifted.hasDepth();
    c.lifted.sideways_m = has_depth ? 0.005 : 0.002;
    if (has_depth) c.lifted.along_m = 0.02;
  }
  return world;
}

// Without noise the loss is a square.  What rows say counts for more than its curvature, as the loss takes some of
// it away again (see nees_test.cpp); what priors say does not.
TEST(Refine, InformationIsTheCostsCurvature) {
  RefineProblem p(exactMixedWorld());
  const Rigid &truth = p.world.camera_from_map;
  PosePrior prior = test::gravityPrior(p.world, 1e-3, 1);
  prior.up_camera = truth.rotation * prior.up_map;
  p.task.scale2 = 1e9;
  p.task.prior = &prior;
  p.task.depth = biasPrior(0.004, 0.003);
  const test::PoseCost cost = {truth, kMidM, 1e9, 1e12};
  const Matrix8 lifted = test::curvatureOf([&](const Vector8 &step) { return halfLifted(p, cost, step); });
  const Matrix8 planes = test::curvatureOf([&](const Vector8 &step) { return halfPlanes(p, cost, step); });
  const Matrix8 priors = test::curvatureOf([&](const Vector8 &step) { return halfPriors(p, cost, step); });
  const Matrix8 information = refinePose(p.task, truth, 0).information;
  EXPECT_LT(difference(information, lifted / 0.80 + planes / 0.93 + priors), 3e-3);
}

// A wide prior: the rows alone tell the slope when the offset is known.
TEST(Refine, RecoversASlope) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    RefineProblem p(biasedWorld(seed, 0, 0.02));
    p.task.depth = biasPrior(1e-5, 1);
    const Refinement refined = refinePose(p.task, p.world.camera_from_map, 30);
    EXPECT_NEAR(refined.bias[1], 0.02, 2e-4) << seed;
    EXPECT_NEAR(refined.bias[0], 0, 1e-4) << seed;
    EXPECT_LT(test::translationErrorM(refined.camera_from_map, p.world.camera_from_map), 3e-4) << seed;
  }
}
TEST(Refine, RecoversAnOffset) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    RefineProblem p(biasedWorld(seed, 0.02, 0));
    p.task.depth = biasPrior(1, 1e-5);
    const Refinement refined = refinePose(p.task, p.world.camera_from_map, 30);
    EXPECT_NEAR(refined.bias[0], 0.02, 3e-4) << seed;
    EXPECT_LT(test::translationErrorM(refined.camera_from_map, p.world.camera_from_map), 5e-4) << seed;
  }
}

// Both unknown: what is left once a common scale is taken away, the offset at zero depth over 1 + slope.
TEST(Refine, RecoversWhatDirectionsSeeOfABias) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    RefineProblem p(biasedWorld(seed, 0.01, 0.02));
    p.task.depth = biasPrior(1, 1);
    const Vector2 bias = refinePose(p.task, p.world.camera_from_map, 50).bias;
    EXPECT_NEAR((bias[0] - bias[1] * kMidM) / (1 + bias[1]), (0.01 - 0.02 * kMidM) / 1.02, 5e-4) << seed;
  }
}

// All depths longer by one factor: the map cannot tell, and the belief "right at mid range" stands.
TEST(Refine, ACommonScaleIsAGauge) {
  for (double scale : {0.97, 1.03})
    for (uint64_t seed = 1; seed <= 5; ++seed) {
      RefineProblem p(exactWorld(seed, scale));
      p.task.depth = biasPrior(0.01, 0.02);
      const Refinement refined = refinePose(p.task, p.world.camera_from_map, 30);
      EXPECT_NEAR(refined.bias[0], 0, 1e-4);
      EXPECT_NEAR(refined.bias[1], 0, 1e-4);
      EXPECT_LT(test::rotationErrorRad(refined.camera_from_map, p.world.camera_from_map), 1e-4);
      EXPECT_LT((refined.camera_from_map.translation_m - scale * p.world.camera_from_map.translation_m).norm(),
                1e-4);
    }
}

struct Drift {
  Vector2 mean, standard_error;
};
Drift driftOver(int worlds, double true_share) {
  Vector2 sum = Vector2::Zero(), squares = Vector2::Zero();
  for (int seed = 1; seed <= worlds; ++seed) {
    test::SensorWorldOptions options;
    options.seed = static_cast<uint64_t>(seed);
    options.true_share = true_share;
    options.states_from_truth = true;
    RefineProblem p(test::makeSensorWorld(options));
    p.task.depth = biasPrior(0.01, 0.02);
    const Vector2 bias = refinePose(p.task, p.world.camera_from_map, 20).bias;
    sum += bias;
    squares += bias.cwiseProduct(bias);
  }
  const Vector2 mean = sum / worlds;
  return {mean, ((squares / worlds - mean.cwiseProduct(mean)) / (worlds - 1)).cwiseSqrt()};
}

void expectNoDrift(const Drift &drift) {
  for (int i = 0; i < 2; ++i) {
    ::testing::Test::RecordProperty(i == 0 ? "offset_sigmas" : "slope_sigmas",
                                    std::to_string(drift.mean[i] / drift.standard_error[i]));
    EXPECT_LT(std::abs(drift.mean[i]), 3 * drift.standard_error[i]) << i << ": " << drift.mean[i];
  }
}

TEST(Refine, NoiseMakesNoBias) { expectNoDrift(driftOver(200, 1)); }
TEST(Refine, NoiseAndFakesMakeNoBias) { expectNoDrift(driftOver(200, 0.33)); }

TEST(Refine, TheVerticalPulls) {
  RefineProblem p(noisyWorld(1));
  PosePrior prior = test::gravityPrior(p.world, 1e-5, 1);
  prior.up_camera = rotationFromVector(Vector3(0.002, 0, 0)) * p.world.camera_from_map.rotation * prior.up_map;
  p.task.prior = &prior;
  const Refinement refined = refinePose(p.task, p.world.camera_from_map, 30);
  EXPECT_LT((refined.camera_from_map.rotation * prior.up_map - prior.up_camera).norm(), 1e-4);
  prior.up_sigma_rad = 1e3;
  const Refinement free = refinePose(p.task, p.world.camera_from_map, 30);
  p.task.prior = nullptr;
  const Refinement without = refinePose(p.task, p.world.camera_from_map, 30);
  EXPECT_LT(test::rotationErrorRad(free.camera_from_map, without.camera_from_map), 1e-6);
}

TEST(Refine, NothingToGoBy) {
  const RefineProblem p({});
  const Refinement refined = refinePose(p.task, Rigid(), 5);
  EXPECT_EQ(refined.cost, 0);
  EXPECT_TRUE(isFinite(refined.camera_from_map.rotation.sum()));
}

}  // namespace
}  // namespace sphc
