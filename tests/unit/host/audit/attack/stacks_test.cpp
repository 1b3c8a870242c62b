#include "host/audit/attack/stacks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "host/audit/score/auc.h"
#include "host/publish/secret_random.h"
#include "runtime/stages/features/mirrored_descriptor.h"
#include "tests/unit/host/audit/made_up_cloud.h"

namespace sphc::host {
namespace {

constexpr size_t kStacks = 40, kStackPoints = 60;
constexpr double kWidthRad = 0.03;

// On a spiral, far apart.
Vector3 middleOf(size_t stack) {
  const double z = 1 - (2.0 * static_cast<double>(stack) + 1) / kStacks, turn = 2.4 * static_cast<double>(stack);
  return {std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z};
}

std::vector<Vector3> stackedDirections(Random *random) {
  std::vector<Vector3> directions;
  for (size_t i = 0; i < kStacks * kStackPoints; ++i)
    directions.push_back((middleOf(i % kStacks) + kWidthRad * test::normalVector(random)).normalized());
  return directions;
}

TEST(Stacks, AreFoundByDirectionsAlone) {
  Random random(1);
  const std::vector<uint32_t> labels = stacksOf(stackedDirections(&random));
  ASSERT_EQ(labels.size(), kStacks * kStackPoints);
  EXPECT_EQ(std::set<uint32_t>(labels.begin(), labels.end()).size(), kStacks);
  for (size_t i = 0; i < labels.size(); ++i) EXPECT_EQ(labels[i], labels[i % kStacks]) << i;
}

TEST(Stacks, OfFewPointsAreFoundToo) {
  EXPECT_EQ(stacksOf({Vector3::UnitX(), Vector3::UnitX(), Vector3::UnitZ()}), (std::vector<uint32_t>{0, 0, 1}));
}

// What looks alike belongs to one of 8 regions.  A third of a stack's points are of the region it is in, the others
// of any: mirrored, as fakes are.
TEST(Stacks, WhatGoesOnInOtherStacksIsReal) {
  Random random(2);
  std::vector<Descriptor> regions;
  for (int i = 0; i < 8; ++i) regions.push_back(test::randomDescriptor(&random));
  const std::vector<Vector3> directions = stackedDirections(&random);
  std::vector<Descriptor> descriptors;
  std::vector<bool> real;
  for (size_t i = 0; i < directions.size(); ++i) {
    const Vector3 middle = middleOf(i % kStacks);
    const size_t here = static_cast<size_t>((middle.x() > 0) + 2 * (middle.y() > 0) + 4 * (middle.z() > 0));
    real.push_back(i / kStacks % 3 == 0);
    const Descriptor seen = nearTo(regions[real.back() ? here : random.below(8)], &random);
    descriptors.push_back(real.back() ? seen : mirrored(seen));
  }
  const auto auc = [&](const std::vector<Vector3> &shown) {
    const Eigen::ArrayXf scores =
        lookalikesInOtherStacks(shown, descriptorNeighbours(descriptors, 16), stacksOf(shown));
    return areaUnderCurve({scores.begin(), scores.end()}, real);
  };
  EXPECT_GT(auc(directions).value, 0.8);
  std::vector<Vector3> elsewhere = directions;  // the same stacks, with others in them
  SecretRandom secret({3});
  shuffle(&elsewhere, &secret);
  const Auc chance = auc(elsewhere);
  EXPECT_NEAR(chance.value, 0.5, 4 * chance.standard_error);
}

}  // namespace
}  // namespace sphc::host
