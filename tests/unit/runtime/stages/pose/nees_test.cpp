// Is the covariance what it says?  Normalised estimation error squared (Bar-Shalom, Li, Kirubarajan, "Estimation
// with Applications to Tracking and Navigation", 2001, section 5.4): e^T C^-1 e averages to the six degrees of
// freedom.
#include <gtest/gtest.h>

#include <cmath>

#include "runtime/stages/pose/estimator.h"
#include "tests/support/dense_matrix.h"
#include "tests/support/random_numbers.h"
#include "tests/support/sensor_world.h"
#include "tests/unit/runtime/stages/pose/pose_test_estimator.h"

namespace sphc {
namespace {

constexpr int kWorlds = 600;

struct Setting {
  double true_share = 1, depthless_share = 0;
  double offset_sigma_m = 0, slope_sigma = 0;  // of the bias, drawn for each world
  bool states_from_truth = false;
  double up_sigma_rad = 0;  // of a known vertical; 0: none
};

// Means over worlds: of the pose, of its two halves, and of the bias.
struct Nees {
  double pose = 0, rotation = 0, translation = 0, bias = 0;
};

Nees neesOf(const Setting &setting) {
  test::TestEstimator estimator(512, 20000);
  Nees nees;
  Random random(99);
  for (int world_seed = 1; world_seed <= kWorlds; ++world_seed) {
    test::SensorWorldOptions options;
    options.seed = static_cast<uint64_t>(world_seed);
    options.true_share = setting.true_share;
    options.depthless_share = setting.depthless_share;
    options.states_from_truth = setting.states_from_truth;
    options.bias = {setting.offset_sigma_m * test::normal(&random), setting.slope_sigma * test::normal(&random)};
    PoseQuery query;
    query.seed = options.seed;
    query.depth.mid_m = options.mid_m;
    query.depth.covariance.diagonal() << std::pow(setting.offset_sigma_m, 2), std::pow(setting.slope_sigma, 2);
    const test::PoseWorld world = test::makeSensorWorld(options);
    const PosePrior vertical = test::gravityPrior(world, setting.up_sigma_rad, options.seed);
    if (setting.up_sigma_rad > 0) query.prior = &vertical;
    const Estimate estimate = estimator.search(world, query);
    const Vector6 xi = test::poseError(estimate.camera_from_map, world.camera_from_map);
    const Matrix6 &c = estimate.covariance;
    nees.pose += test::normalisedSquared(xi, c) / kWorlds;
    nees.rotation += test::normalisedSquared(xi.head<3>(), c.topLeftCorner<3, 3>()) / kWorlds;
    nees.translation += test::normalisedSquared(xi.tail<3>(), c.bottomRightCorner<3, 3>()) / kWorlds;
    const Vector2 off = estimate.depth.mean - options.bias;
    if (!query.depth.isKnown()) nees.bias += test::normalisedSquared(off, estimate.depth.covariance) / kWorlds;
  }
  return nees;
}

// The mean of chi-squares over the worlds is within its 95 % band.
void expectInBand(double mean, double degrees) {
  const double half_band = 1.96 * std::sqrt(2 * degrees / kWorlds);
  EXPECT_NEAR(mean, degrees, half_band);
}

void expectConsistent(const Setting &setting) {
  const Nees nees = neesOf(setting);
  ::testing::Test::RecordProperty("pose_of_6", std::to_string(nees.pose));
  ::testing::Test::RecordProperty("rotation_of_3", std::to_string(nees.rotation));
  ::testing::Test::RecordProperty("translation_of_3", std::to_string(nees.translation));
  ::testing::Test::RecordProperty("bias_of_2", std::to_string(nees.bias));
  expectInBand(nees.pose, 6);
  if (setting.slope_sigma > 0) expectInBand(nees.bias, 2);
}

TEST(Nees, AllTrue) { expectConsistent({1, 0, 0, 0}); }
TEST(Nees, AThirdTrue) { expectConsistent({0.33, 0, 0, 0}); }
TEST(Nees, AllTrueWithBias) { expectConsistent({1, 0, 0.005, 0.01}); }
TEST(Nees, AThirdTrueWithBias) { expectConsistent({0.33, 0, 0.005, 0.01}); }
TEST(Nees, AThirdWithoutDepth) { expectConsistent({1, 0.33, 0, 0}); }
TEST(Nees, AThirdTrueWithoutDepthAndWithBias) { expectConsistent({0.33, 0.33, 0.005, 0.01}); }
// Errors are stated for the measured depth above, and for the true one here.
TEST(Nees, AllTrueExactlyAsStated) { expectConsistent({1, 0, 0.005, 0.01, true}); }
TEST(Nees, AThirdTrueExactlyAsStated) { expectConsistent({0.33, 0, 0.005, 0.01, true}); }
TEST(Nees, AThirdTrueWithAVertical) { expectConsistent({0.33, 0, 0.005, 0.01, false, 2e-3}); }

}  // namespace
}  // namespace sphc
