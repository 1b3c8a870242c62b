#include "lab/frame/bench.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>

#include "lab/frame/plots.h"
#include "lab/frame/table.h"

namespace sphc::host {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct Call {
  std::string variant;
  uint32_t frame, repeat;
};

// Answers the truth, off by `off_m`, after `seconds` that grow by a tenth with each repeat.
FrameVariant scripted(const std::string &name, double seconds, std::vector<Call> *calls, double off_m = 0) {
  return {name,
          [=](const FrameCase &frame, uint32_t repeat) {
            calls->push_back({name, frame.index, repeat});
            FrameAnswer answer;
            answer.pose.camera_from_map = frame.truth_camera_from_world;
            answer.pose.camera_from_map.translation_m.x() += off_m;
            answer.pose.found = true;
            answer.pose.seconds = seconds * (1 + 0.1 * repeat);
            answer.stages[kMatch] = 0.5 * answer.pose.seconds;
            answer.stages[kAlign] = std::numeric_limits<double>::quiet_NaN();
            return answer;
          },
          "",
          {1000, 2000, 66000}};
}

FrameBenchInput someFrames(uint32_t count, uint32_t repeats) {
  return {count, repeats, [](uint32_t index, FrameCase *frame) {
            frame->index = index;
            frame->truth_camera_from_world.translation_m = Vector3(index, 2, 3);
            return true;
          }};
}

size_t callsOf(const std::vector<Call> &calls, const std::string &name) {
  return static_cast<size_t>(
      std::count_if(calls.begin(), calls.end(), [&](const Call &call) { return call.variant == name; }));
}

TEST(FrameBench, EveryVariantRunsInEveryRepeatOfAFrameBeforeTheNext) {
  std::vector<Call> calls;
  runFrameBench(someFrames(20, 3), {scripted("a", 1e-3, &calls), scripted("b", 1e-3, &calls)}, nullptr);
  ASSERT_EQ(calls.size(), 120u);
  std::string order;
  for (size_t i = 0; i < calls.size(); ++i) {
    EXPECT_EQ(calls[i].frame, i / 6);
    EXPECT_EQ(calls[i].repeat, i / 2 % 3);
    order += calls[i].variant;
  }
  EXPECT_EQ(callsOf(calls, "a"), 60u);
  EXPECT_THAT(order, HasSubstr("aa"));  // the order changes
  EXPECT_THAT(order, HasSubstr("bb"));
}

TEST(FrameBench, TimesAreMediansOfTheRepeatsAndThePoseIsOfTheFirst) {
  std::vector<Call> calls;
  const auto runs = runFrameBench(someFrames(1, 3), {scripted("a", 1e-3, &calls, 0.03)}, nullptr);
  EXPECT_NEAR(runs[0].poses.samples[0].seconds, 1.1e-3, 1e-12);
  EXPECT_NEAR(runs[0].stages[0][kMatch], 0.55e-3, 1e-12);
  EXPECT_NEAR(runs[0].stages[0][kTotal], 1.1e-3, 1e-12);
  EXPECT_NEAR(runs[0].poses.samples[0].translation_error_m, 0.03, 1e-9);
}

TEST(FrameBench, WhatIsSlowOnTheFirstFrameRunsOnceAFrame) {
  std::vector<Call> calls;
  runFrameBench(someFrames(4, 3), {scripted("slow", 0.06, &calls), scripted("fast", 1e-3, &calls)}, nullptr);
  EXPECT_EQ(callsOf(calls, "slow"), 4u);
  EXPECT_EQ(callsOf(calls, "fast"), 12u);
}

TEST(FrameBench, FramesThatCannotBeReadAndAbsentVariantsAreLeftOut) {
  std::vector<Call> calls;
  FrameBenchInput input = someFrames(4, 1);
  const ReadFrame all = input.read;
  input.read = [all](uint32_t index, FrameCase *frame) { return index % 2 == 0 && all(index, frame); };
  const auto runs = runFrameBench(input, {scripted("a", 1e-3, &calls), {"absent", nullptr, "why", {}}}, nullptr);
  ASSERT_EQ(runs.size(), 1u);
  EXPECT_EQ(runs[0].poses.samples.size(), 2u);
}

FrameTable someTable(uint32_t points, double peer_s) {
  std::vector<Call> calls;
  FrameTable table = {"room", "map.sphc", points, 10, {}, {}};
  FrameVariant peer = scripted(kFramePeerName, peer_s, &calls, 0.06);
  peer.memory = {};
  table.runs = runFrameBench(someFrames(10, 1), {scripted("ours, cold", 2e-3, &calls), peer}, nullptr);
  table.summaries = summarizeFrameBench(table.runs);
  return table;
}

TEST(FrameBench, SummaryHasMediansStagesRecallAndTheRatio) {
  const FrameTable table = someTable(500, 30e-3);
  const FrameSummary &ours = table.summaries[0], &peer = table.summaries[1];
  EXPECT_NEAR(ours.times_faster, 15, 1e-9);
  EXPECT_NEAR(peer.times_faster, 1, 1e-12);
  EXPECT_NEAR(ours.stage_ms[kMatch], 1, 1e-9);
  EXPECT_TRUE(std::isnan(ours.stage_ms[kAlign]));
  EXPECT_EQ(ours.pose.within_5cm_5deg_percent, 100);
  EXPECT_EQ(peer.pose.within_5cm_5deg_percent, 0);
  EXPECT_TRUE(std::isnan(summarizeFrameBench({table.runs[0]})[0].times_faster));
}

TEST(FrameBench, TheLedgerHasRatiosAndBytesAndNoMilliseconds) {
  const std::vector<FrameTable> tables = {someTable(500, 30e-3)};
  const std::string results = frameResults(tables);
  EXPECT_THAT(results, HasSubstr("\nroom,500,10,\"ours, cold\",15.00,100.0,100.0,0.000,0.000,1000,2000,132.0\n"));
  EXPECT_THAT(results,
              HasSubstr(std::string("\nroom,500,10,\"") + kFramePeerName + "\",1.00,100.0,0.0,6.000,0.000,,,\n"));
  EXPECT_THAT(results, testing::Not(HasSubstr("ms")));
  EXPECT_THAT(frameCsv(tables), HasSubstr("\nroom,500,10,\"ours, cold\",2.0000,"));
  EXPECT_THAT(frameTableText(tables[0]), HasSubstr("room, map.sphc, 500 points, 10 frames\n"));
  EXPECT_TRUE(frameJson(tables)[0]["variants"][1]["map_bytes_a_point"].is_number_float());
}

TEST(FrameBench, CsvRowsHaveAsManyFieldsAsTheHead) {
  for (const std::string &csv : {frameCsv({someTable(500, 0.03)}), frameResults({someTable(500, 0.03)})}) {
    std::vector<int64_t> commas(1);
    bool quoted = false;
    for (const char c : csv) {
      if (c == '"') quoted = !quoted;
      if (c == ',' && !quoted) ++commas.back();
      if (c == '\n') commas.push_back(0);
    }
    EXPECT_THAT(commas, ElementsAre(commas[0], commas[0], commas[0], 0));
  }
}

TEST(FrameBench, SeveralMapsGiveAScalingTableAndAPlot) {
  const std::vector<FrameTable> tables = {someTable(500, 30e-3), someTable(5000, 60e-3)};
  EXPECT_EQ(frameScalingText({tables[0]}), "");
  EXPECT_THAT(frameScalingText(tables), testing::ContainsRegex("faiss ivf 16 +30.00 +60.00"));
  EXPECT_EQ(drawFrameScaling({tables[0]}).script, "");
  EXPECT_THAT(drawFrameScaling(tables).script, HasSubstr("500 30.0000\n5000 60.0000\n"));
}

TEST(FrameBench, BarsOfStagesEndWhereTheNextBegins) {
  const FrameTable table = someTable(500, 30e-3);
  EXPECT_THAT(drawFrameStages(table, false).script, HasSubstr("\n1 0 0.0000 0.0000 1.0000 1.0000 2.0000\n"));
  EXPECT_THAT(drawFrameStages(table, true).script, testing::Not(HasSubstr("faiss")));
  EXPECT_NE(drawFrameStages(table, false).name, drawFrameStages(table, true).name);
}

}  // namespace
}  // namespace sphc::host
