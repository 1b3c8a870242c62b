#include "lab/pose/growth.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "lab/pose/grown_case.h"
#include "simulated_case.h"

namespace sphc::host {
namespace {

size_t trueRows(const PoseCase &c) {
  return static_cast<size_t>(std::count(c.is_true.begin(), c.is_true.end(), true));
}

// Rows that are said to be true lie on their rays.
void expectTruthHolds(const PoseCase &c, double tolerance) {
  for (size_t i = 0; i < c.correspondences.size(); ++i) {
    if (!c.is_true[i]) continue;
    const Vector3 seen = (c.truth_camera_from_map.inverse() * c.correspondences[i].lifted.point_m).normalized();
    EXPECT_GT(seen.dot(c.correspondences[i].direction), 1 - tolerance);
  }
}

TEST(PoseGrowth, FewerRowsAreSomeOfThemMoreAreCopiesWithNoise) {
  const PoseCase original = test::simulatedCase(400, 4);
  Random random(1);
  const PoseCase fewer = resizedCase(original, 100, {}, &random);
  EXPECT_EQ(fewer.correspondences.size(), 100u);
  EXPECT_EQ(fewer.true_points_map_m.size(), 100u);
  EXPECT_NEAR(static_cast<double>(trueRows(fewer)), 25, 12);
  expectTruthHolds(fewer, 1e-12);
  const PoseCase more = resizedCase(original, 1000, {}, &random);
  EXPECT_EQ(more.correspondences.size(), 1000u);
  EXPECT_EQ(more.is_true.size(), 1000u);
  EXPECT_EQ(more.true_pixels_px.size(), 1000u);
  EXPECT_NEAR(static_cast<double>(trueRows(more)), 250, 40);
  expectTruthHolds(more, 1e-3);
}

TEST(PoseGrowth, TurnedKeepsTheRowsAndReachesEta) {
  Random random(1);
  const PoseCase c = turnedCase(test::simulatedCase(400, 4), 0.1, &random);
  EXPECT_EQ(c.correspondences.size(), 400u);
  EXPECT_EQ(trueRows(c), 40u);
  EXPECT_EQ(c.eta_percent, 10u);
  expectTruthHolds(c, 1e-12);
}

TEST(PoseGrowth, DilutedKeepsTheTrueRowsAndReachesEta) {
  Random random(1);
  const PoseCase c = dilutedCase(test::simulatedCase(400, 4), 0.1, &random);
  EXPECT_EQ(trueRows(c), 100u);
  EXPECT_EQ(c.correspondences.size(), 1000u);
  expectTruthHolds(c, 1e-12);
}

TEST(PoseGrowth, EmptyCasesStayEmpty) {
  Random random(1);
  const PoseCase empty = test::simulatedCase(0, 1);
  EXPECT_TRUE(resizedCase(empty, 100, {}, &random).correspondences.empty());
  EXPECT_TRUE(turnedCase(empty, 0.1, &random).correspondences.empty());
  EXPECT_TRUE(dilutedCase(empty, 0.1, &random).correspondences.empty());
}

TEST(PoseGrowth, TablesHaveARowEachPointAndVariant) {
  const GrowthInput input = {"room", {test::simulatedCase(100, 4)}, DepthSource::kTof, {}};
  const PoseVariant variant = {"v", false, [](const PoseCase &, uint64_t) { return PoseAnswer(); }, ""};
  EXPECT_EQ(growCounts(input, {variant}, {1, 1}, nullptr).size(), 7u);
  const auto etas = growEtas(input, {variant}, {1, 1}, nullptr);
  EXPECT_EQ(etas.size(), 5u);  // as they are, and 15 and 10 % in two ways
  const std::string csv = growthCsv(etas);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 6);
}

}  // namespace
}  // namespace sphc::host
