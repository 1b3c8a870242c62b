// Normal equations of the kernels against derivatives by differences.
#include <gtest/gtest.h>

#include "tests/support/pose_cost.h"
#include "tests/support/pose_rows.h"
#include "tests/support/random_numbers.h"
#include "tests/support/sensor_world.h"

namespace sphc {
namespace {

struct Sums {
  Matrix8 matrix;
  Vector8 gradient;
  double cost;
};

Sums sumsOf(const NormalSums &sums) {
  Sums out;
  for (uint32_t i = 0, entry = 0; i < kPoseUnknowns; ++i) {
    out.gradient[i] = static_cast<double>(sums.gradient[i]);
    for (uint32_t j = i; j < kPoseUnknowns; ++j, ++entry)
      out.matrix(i, j) = out.matrix(j, i) = static_cast<double>(sums.matrix[entry]);
  }
  out.cost = static_cast<double>(sums.cost);
  return out;
}

NormalTask taskOf(const test::PoseCost &cost, bool with_bias) {
  NormalTask task = {};
  task.pose = poseF(cost.camera_from_map);
  task.correction = {0, 0, static_cast<float>(cost.mid_m), 1};
  task.inverse_scale2 = static_cast<float>(1 / cost.scale2);
  task.gate2 = static_cast<float>(cost.gate2);
  task.with_bias = with_bias;
  return task;
}

// Kernel sums, and the cost they should be the derivatives of.  The bias belongs to depths: planes have none.
struct Case {
  test::PoseWorld world;
  test::PoseCost cost;
  bool planes;

  Sums sums() const {
    const test::OwnedRows owned(world.correspondences, simdPoseKernels());
    NormalSums out;
    if (planes)
      simdPoseKernels().plane_equations(owned.rows, taskOf(cost, true), &out);
    else
      simdPoseKernels().lifted_equations(owned.rows, taskOf(cost, true), &out);
    return sumsOf(out);
  }
  double costAt(const Vector8 &step) const {
    double sum = 0;
    for (const Correspondence &c : world.correspondences)
      sum += planes ? cost.plane(c, step) : cost.lifted(c, step);
    return sum;
  }
};

// Every second row is seen by another camera of the rig.
void moveCentres(test::PoseWorld *world) {
  Random random(7);
  for (size_t i = 0; i < world->correspondences.size(); i += 2) {
    const Vector3 centre_m(0.1 * test::normal(&random), 0.1 * test::normal(&random), 0.1 * test::normal(&random));
    world->correspondences[i].lifted.centre_m = centre_m.cast<float>();
  }
}

Case makeCase(bool planes, bool exact, uint64_t seed) {
  test::SensorWorldOptions options;
  options.seed = seed;
  options.true_share = exact ? 1 : 0.6;
  options.depthless_share = planes ? 0.5 : 0;
  test::PoseWorld world;
  if (exact) {
    test::PoseWorldOptions plain;
    plain.seed = seed;
    world = test::makePoseWorld(plain);
  } else {
    world = test::makeSensorWorld(options);
  }
  test::PoseCost cost = {world.camera_from_map, 2, 8, 512};
  return {world, cost, planes};
}

// Largest difference of two entries, each in units of its unknowns' curvatures.
double difference(const Matrix8 &a, const Matrix8 &b, int unknowns) {
  double worst = 0;
  for (int i = 0; i < unknowns; ++i)
    for (int j = 0; j < unknowns; ++j)
      worst = std::max(worst, std::abs(a(i, j) - b(i, j)) / std::sqrt(b(i, i) * b(j, j)));
  return worst;
}

void expectCurvature(bool planes, int unknowns) {
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    Case c = makeCase(planes, true, seed);
    c.cost.scale2 = 1e9;
    c.cost.gate2 = 1e12;
    const Matrix8 half = 0.5 * test::curvatureOf([&](const Vector8 &step) { return c.costAt(step); });
    EXPECT_LT(difference(c.sums().matrix, half, unknowns), 2e-3);
  }
}

void expectCurvatureOfARig(bool planes) {
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    Case c = makeCase(planes, true, seed);
    moveCentres(&c.world);
    c.cost.scale2 = 1e9;
    c.cost.gate2 = 1e12;
    const Matrix8 half = 0.5 * test::curvatureOf([&](const Vector8 &step) { return c.costAt(step); });
    EXPECT_LT(difference(c.sums().matrix, half, 6), 2e-3);
  }
}

TEST(Equations, LiftedMatrixOfARigIsTheCostsCurvature) { expectCurvatureOfARig(false); }
TEST(Equations, PlaneMatrixOfARigIsTheCostsCurvature) { expectCurvatureOfARig(true); }

TEST(Equations, LiftedMatrixIsTheCostsCurvature) { expectCurvature(false, 8); }
TEST(Equations, PlaneMatrixIsTheCostsCurvature) { expectCurvature(true, 6); }

TEST(Equations, PlanesSayNothingOfTheBias) {
  const Sums sums = makeCase(true, false, 1).sums();
  EXPECT_EQ(sums.matrix.bottomRows<2>().norm(), 0);
  EXPECT_EQ(sums.gradient.tail<2>().norm(), 0);
}

// With noise, fakes and the loss, near the truth.
void expectGradient(bool planes, bool of_a_rig) {
  Random random(1);
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    Case c = makeCase(planes, false, seed);
    if (of_a_rig) moveCentres(&c.world);
    Vector8 off = Vector8::Zero();
    for (int i = 0; i < 6; ++i) off[i] = 0.003 * test::normal(&random);
    c.cost.camera_from_map = c.cost.moved(off);
    const Sums sums = c.sums();
    const Vector8 half = 0.5 * test::gradientOf([&](const Vector8 &step) { return c.costAt(step); });
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(sums.gradient[i], half[i], 3e-3 * half.head<6>().norm()) << i;
    // rows that fill the last chunk are behind the camera
    const double padding = static_cast<double>(kPoseChunk - c.world.correspondences.size() % kPoseChunk);
    EXPECT_NEAR(sums.cost - padding * c.cost.scale2, c.costAt(Vector8::Zero()), 1e-4 * sums.cost);
  }
}

TEST(Equations, LiftedGradientIsTheCosts) { expectGradient(false, false); }
TEST(Equations, PlaneGradientIsTheCosts) { expectGradient(true, false); }
TEST(Equations, LiftedGradientOfARigIsTheCosts) { expectGradient(false, true); }
TEST(Equations, PlaneGradientOfARigIsTheCosts) { expectGradient(true, true); }

// The bias is taken at the foot of the ray, so that noise does not pull it: the cost's own gradient to first order.
TEST(Equations, BiasGradientIsTheCostsNearTheSolution) {
  Random random(2);
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    Case c = makeCase(false, true, seed);
    Vector8 off = Vector8::Zero();
    for (int i = 0; i < 6; ++i) off[i] = 1e-4 * test::normal(&random);
    c.cost.camera_from_map = c.cost.moved(off);
    const Sums sums = c.sums();
    const Vector8 half = 0.5 * test::gradientOf([&](const Vector8 &step) { return c.costAt(step); });
    for (int i = 6; i < 8; ++i)
      EXPECT_NEAR(sums.gradient[i], half[i], 0.02 * std::abs(half[i]) + 0.5) << i << " of " << half.norm();
  }
}

TEST(Equations, WithoutBiasThePoseEntriesAreTheSame) {
  const Case c = makeCase(false, false, 3);
  const test::OwnedRows owned(c.world.correspondences, simdPoseKernels());
  NormalSums plain;
  simdPoseKernels().lifted_equations(owned.rows, taskOf(c.cost, false), &plain);
  const Sums with = c.sums(), without = sumsOf(plain);
  EXPECT_TRUE((with.matrix.topLeftCorner<6, 6>()).isApprox(without.matrix.topLeftCorner<6, 6>(), 1e-5));
  EXPECT_EQ(without.matrix.bottomRows<2>().norm(), 0);
}

}  // namespace
}  // namespace sphc
