// The hard cases, the fit, the tables; and the model itself on made-up worlds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lab/confidence/fit.h"
#include "lab/confidence/table.h"
#include "lab/pose/ours.h"
#include "tests/unit/lab/pose/simulated_case.h"

namespace sphc::host {
namespace {

using testing::HasSubstr;

ConfidenceQuery simulatedQuery() { return {test::simulatedCase(400, 1), sensorPrior(DepthSource::kTof)}; }

size_t trueRows(const PoseCase &c) {
  return static_cast<size_t>(std::count(c.is_true.begin(), c.is_true.end(), true));
}

TEST(HardQuery, HasTheRowsAndTheFakesAskedFor) {
  Random random(1);
  const PoseCase c = hardQuery(simulatedQuery(), {100, 0.25, 1, false}, {}, &random).pose_case;
  EXPECT_EQ(c.correspondences.size(), 100u);
  EXPECT_NEAR(static_cast<double>(trueRows(c)), 25, 12);
}

TEST(HardQuery, DepthNoiseIsAddedOrStated) {
  Random random(1);
  const ConfidenceQuery plain = simulatedQuery();
  const auto noisy = hardQuery(plain, {0, 1, 3, false}, {}, &random).pose_case.correspondences;
  const auto modest = hardQuery(plain, {0, 1, 0.5, false}, {}, &random).pose_case.correspondences;
  double squares = 0;
  for (size_t i = 0; i < noisy.size(); ++i) {
    const LiftedPoint &before = plain.pose_case.correspondences[i].lifted;
    const double added = (noisy[i].lifted.point_m - before.point_m).norm() / before.along_m;
    squares += added * added / static_cast<double>(noisy.size());
    EXPECT_EQ(modest[i].lifted.point_m, before.point_m);
    EXPECT_DOUBLE_EQ(modest[i].lifted.along_m, 2 * before.along_m);
  }
  EXPECT_NEAR(squares, 8, 1.5);  // 3^2 - 1
}

TEST(HardQuery, AtTheWrongPlaceNothingIsTrue) {
  Random random(1);
  const PoseCase c = hardQuery(simulatedQuery(), {0, 1, 1, true}, {}, &random).pose_case;
  EXPECT_EQ(trueRows(c), 0u);
  EXPECT_EQ(c.correspondences.size(), 400u);
}

TEST(MadeWorlds, RowsLieOnTheirRays) {
  for (const MadeWorld world : {MadeWorld::kRoom, MadeWorld::kObjects}) {
    for (uint64_t seed = 0; seed < 10; ++seed) {
      const PoseCase c = madeQuery(world, seed, {}).pose_case;
      ASSERT_GE(c.correspondences.size(), 50u) << worldName(world);
      double worst = 1;
      for (const Correspondence &row : c.correspondences) {
        const Vector3 seen = c.truth_camera_from_map.inverse() * row.lifted.point_m;
        if (seen.norm() > 0.5) worst = std::min(worst, seen.normalized().dot(row.direction));
      }
      EXPECT_GT(worst, 0.8) << worldName(world);  // noise of depth turns rays that begin elsewhere
    }
  }
}

// Poses that are right with the probability that a known model gives them.
std::vector<ConfidenceRun> runsOf(const ConfidenceModel &model, size_t count) {
  Random random(1);
  std::vector<ConfidenceRun> runs(count);
  for (ConfidenceRun &run : runs) {
    run.inputs = {0.02 + 0.9 * random.uniform(), 3 + 17 * random.uniform(), random.uniform(),
                  0.1 * random.uniform(), 0.2 * random.uniform()};
    ConfidenceFeatures features;
    confidenceFeatures(run.inputs, &features);
    run.correct = random.uniform() < confidenceFrom(model, features);
  }
  return runs;
}

TEST(FitConfidence, FindsTheModelThatMadeTheData) {
  const ConfidenceModel truth = {-2, {1, 2, 3, 1.5}};
  const ConfidenceModel found = fitConfidence(runsOf(truth, 20000));
  EXPECT_NEAR(found.intercept, truth.intercept, 0.3);
  for (int k = 0; k < kConfidenceFeatures; ++k) EXPECT_NEAR(found.weight[k], truth.weight[k], 0.25) << k;
}

TEST(FitConfidence, LeavesOutWhatWouldHaveANegativeWeight) {
  const ConfidenceModel found = fitConfidence(runsOf({0, {1, -1, 2, 1}}, 5000));
  EXPECT_EQ(found.weight[1], 0);
  EXPECT_GT(found.weight[0], 0);
}

TEST(FitConfidence, NeedsRightAndWrongPoses) {
  EXPECT_THROW(fitConfidence({}), std::runtime_error);
  EXPECT_THROW(fitConfidence(std::vector<ConfidenceRun>(5)), std::runtime_error);
}

double errorOf(const ConfidenceScene &scene, const ConfidenceModel &model) {
  return calibrationError(equalWidthBins(gradedRuns(scene, model)));
}

// Worlds that it was not fitted on.  A model that is as wrong as twice the odds must not pass.
TEST(ConfidenceModel, HoldsOnMadeUpWorlds) {
  const ConfidenceScene scene = runMadeWorlds(MadeWorld::kObjects, 400, 4242, nullptr);
  ASSERT_GT(scene.runs.size(), 380u);
  EXPECT_LT(errorOf(scene, confidenceModel()), 0.06);
  ConfidenceModel boastful = confidenceModel(), shy = confidenceModel();
  boastful.intercept += 2;
  shy.intercept -= 2;
  EXPECT_GT(errorOf(scene, boastful), 0.06);
  EXPECT_GT(errorOf(scene, shy), 0.06);
}

TEST(ConfidenceRuns, AreTheSameForTheSameSeed) {
  const auto first = runMadeWorlds(MadeWorld::kRoom, 10, 7, nullptr).runs;
  const auto again = runMadeWorlds(MadeWorld::kRoom, 10, 7, nullptr).runs;
  ASSERT_EQ(first.size(), again.size());
  for (size_t i = 0; i < first.size(); ++i)
    EXPECT_EQ(first[i].inputs.centre_sigma_m, again[i].inputs.centre_sigma_m);
}

TEST(ConfidenceTables, HaveALineAPoseAndALineAScene) {
  const ConfidenceScene scene = {"room", true, runsOf(confidenceModel(), 30)};
  const std::string csv = confidenceCsv({scene}, confidenceModel());
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 31);
  EXPECT_THAT(confidenceResults({scene}, confidenceModel()), HasSubstr("\nroom,fitted on,30,"));
  EXPECT_THAT(confidenceText({scene, {"empty", false, {}}}, confidenceModel()), HasSubstr("shown on"));
  EXPECT_THAT(drawConfidence({scene}, confidenceModel()).script, HasSubstr("title 'room, fitted on, ECE"));
}

}  // namespace
}  // namespace sphc::host
