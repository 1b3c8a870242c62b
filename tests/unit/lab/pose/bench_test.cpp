#include "lab/pose/bench.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "lab/pose/table.h"
#include "simulated_case.h"

namespace sphc::host {
namespace {

using testing::HasSubstr;

// Answers the truth after a given time, and writes down that it was called.
PoseVariant scripted(const std::string &name, std::vector<double> seconds, std::string *calls) {
  auto at = std::make_shared<size_t>(0);
  return {name, false,
          [=](const PoseCase &c, uint64_t) {
            *calls += name;
            PoseAnswer answer = {c.truth_camera_from_map, 5, 9, 10, true, seconds[*at % seconds.size()]};
            ++*at;
            return answer;
          },
          ""};
}

TEST(PoseBench, EveryVariantRunsInEveryRepeatInChangingOrder) {
  std::string calls;
  const PoseVariant a = scripted("a", {1e-3}, &calls), b = scripted("b", {1e-3}, &calls);
  const auto runs =
      runPoseBench({test::simulatedCase(10, 1), test::simulatedCase(10, 1)}, {a, b}, {20, 1}, nullptr);
  EXPECT_EQ(runs[1].name, "b");
  EXPECT_EQ(runs[1].samples.size(), 2u);
  ASSERT_EQ(calls.size(), 80u);
  for (size_t i = 0; i < calls.size(); i += 2) EXPECT_NE(calls[i], calls[i + 1]) << i;
  EXPECT_THAT(calls, HasSubstr("aa"));
  EXPECT_THAT(calls, HasSubstr("bb"));
}

TEST(PoseBench, TimeIsTheMedianOfTheRepeats) {
  std::string calls;
  const auto runs =
      runPoseBench({test::simulatedCase(10, 1)}, {scripted("a", {3e-3, 1e-3, 2e-3}, &calls)}, {3, 1}, nullptr);
  EXPECT_EQ(runs[0].samples[0].seconds, 2e-3);
}

TEST(PoseBench, WhatIsSlowRunsOnce) {
  std::string calls;
  runPoseBench({test::simulatedCase(10, 1)}, {scripted("s", {1}, &calls), scripted("f", {1e-3}, &calls)}, {3, 1},
               nullptr);
  EXPECT_EQ(std::count(calls.begin(), calls.end(), 's'), 1);
  EXPECT_EQ(std::count(calls.begin(), calls.end(), 'f'), 3);
}

TEST(PoseBench, AbsentVariantsAreLeftOutAndThoseWithoutTruePointsToo) {
  std::string calls;
  PoseVariant absent = {"absent", false, nullptr, "why"}, needs = scripted("needs", {1e-3}, &calls);
  needs.needs_true_points = true;
  PoseCase c = test::simulatedCase(10, 1);
  EXPECT_EQ(runPoseBench({c}, {absent, needs}, {1, 1}, nullptr).size(), 1u);
  c.true_points_map_m.clear();
  EXPECT_TRUE(runPoseBench({c}, {absent, needs}, {1, 1}, nullptr).empty());
}

TEST(PoseBench, EverySeedIsARun) {
  std::vector<uint64_t> seeds;
  const PoseVariant variant = {"v", false,
                               [&seeds](const PoseCase &, uint64_t seed) {
                                 seeds.push_back(seed);
                                 return PoseAnswer();
                               },
                               ""};
  const PoseCase c = test::simulatedCase(10, 1);
  EXPECT_EQ(runPoseBench({c, c}, {variant}, {1, 4}, nullptr)[0].samples.size(), 8u);
  std::sort(seeds.begin(), seeds.end());
  EXPECT_EQ(std::unique(seeds.begin(), seeds.end()), seeds.end());
}

TEST(PoseBench, ErrorsAreTheAngleAndTheDistanceOfCentres) {
  const Rigid truth = test::simulatedCase(1, 1).truth_camera_from_map;
  PoseAnswer answer = {truth, 0, 0, 4, true, 0};
  // The camera turns by a degree where it stands: R' = D R, t' = D t.
  answer.camera_from_map = Rigid{rotationFromVector({0, kPi / 180, 0}), Vector3::Zero()} * truth;
  PoseSample sample;
  judgePose(answer, truth, &sample);
  EXPECT_NEAR(sample.rotation_error_deg, 1, 1e-9);
  EXPECT_NEAR(sample.translation_error_m, 0, 1e-12);
  answer.camera_from_map = truth;
  answer.camera_from_map.translation_m += Vector3(0, 0.03, 0.04);
  judgePose(answer, truth, &sample);
  EXPECT_NEAR(sample.translation_error_m, 0.05, 1e-12);
}

TEST(PoseBench, MissingAndBrokenAnswersAreFarOff) {
  PoseSample sample;
  judgePose({}, Rigid(), &sample);
  EXPECT_EQ(sample.rotation_error_deg, 180);
  EXPECT_EQ(sample.translation_error_m, 100);
  PoseAnswer broken;
  broken.found = true;
  broken.camera_from_map.translation_m.x() = std::nan("");
  judgePose(broken, Rigid(), &sample);
  EXPECT_FALSE(sample.found);
}

std::vector<VariantRuns> someRuns() {
  std::vector<VariantRuns> runs = {{"ours", {}}, {kPoseLibName, {}}};
  for (int i = 0; i < 100; ++i) {
    PoseSample sample = {1e-3, 0.1, 0.001 * i, 7, 12, 20, true};
    runs[0].samples.push_back(sample);
    sample.seconds = 4e-3;
    runs[1].samples.push_back(sample);
  }
  return runs;
}

TEST(PoseBench, SummaryHasMediansTailsSharesAndTheRatio) {
  const auto summaries = summarizePoseBench(someRuns());
  EXPECT_NEAR(summaries[0].time_ms.median, 1, 1e-12);
  EXPECT_NEAR(summaries[0].times_faster_than_poselib, 4, 1e-12);
  EXPECT_NEAR(summaries[0].translation_cm.median, 4.95, 1e-9);
  EXPECT_NEAR(summaries[0].translation_cm.max, 9.9, 1e-9);
  EXPECT_NEAR(summaries[0].beyond_3cm_percent, 69, 1e-9);
  EXPECT_NEAR(summaries[0].within_5cm_5deg_percent, 51, 1e-9);
  EXPECT_EQ(summaries[0].iterations, 7);
  auto alone = someRuns();
  alone.pop_back();
  EXPECT_TRUE(std::isnan(summarizePoseBench(alone)[0].times_faster_than_poselib));
}

TEST(PoseBench, TheLedgerHasRatiosAndNoMilliseconds) {
  BenchTable table = {"room_eta33", 33, DepthSource::kOracle, 100, someRuns(), {}};
  table.summaries = summarizePoseBench(table.runs);
  const std::string results = benchResults({table}), csv = benchCsv({table});
  EXPECT_THAT(results, HasSubstr("\nroom_eta33,oracle,33,ours,4.00,0.100,"));
  EXPECT_THAT(results, testing::Not(HasSubstr("ms")));
  EXPECT_THAT(csv, HasSubstr("\nroom_eta33,oracle,33,ours,100,100.00,1.0000,"));
  EXPECT_THAT(benchTableText(table), HasSubstr("room_eta33, oracle depth, eta 33 %, 100 queries"));
  EXPECT_EQ(benchJson({table})[0]["variants"][0]["time_ms"]["median"],
            summarizePoseBench(table.runs)[0].time_ms.median);
}

TEST(PoseBench, ACommaInANameIsQuoted) {
  EXPECT_EQ(csvText("ours"), "ours");
  EXPECT_EQ(csvText("ours, upright"), "\"ours, upright\"");
}

}  // namespace
}  // namespace sphc::host
