#include "host/report/json.h"

#include <gtest/gtest.h>

#include <sstream>

#include "frames.h"

namespace sphc::host {
namespace {

TEST(FrameJson, IsALineAFrameThatParses) {
  host::Run run;
  run.base = "world";
  run.frames = {goodFrame(1, 0.02, 1), lostFrame(2)};
  std::istringstream lines(framesJsonLines(run));
  std::string line;
  std::vector<nlohmann::json> frames;
  while (std::getline(lines, line)) frames.push_back(nlohmann::json::parse(line));
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0]["outcome"], "localized");
  EXPECT_NEAR(frames[0]["error"]["translation_m"].get<double>(), 0.02, 1e-9);
  EXPECT_NEAR(frames[0]["world_from_camera"]["t_m"][0].get<double>(), 0.12, 1e-9);
  EXPECT_EQ(frames[1]["outcome"], "no consensus");
  EXPECT_FALSE(frames[1].contains("world_from_camera"));
  EXPECT_FALSE(frames[1].contains("error"));
}

TEST(FrameJson, TellsOfJumps) {
  FrameRecord frame = goodFrame(1, 0, 0);
  frame.events = SPHC_EVENT_JUMPED;
  frame.jump_m = 0.4;
  frame.jump_rad = M_PI / 18;
  const auto json = frameJson(frame, "map");
  EXPECT_EQ(json["events"], "jumped");
  EXPECT_EQ(json["jump"]["translation_m"], 0.4);
  EXPECT_NEAR(json["jump"]["rotation_deg"].get<double>(), 10, 1e-12);
  EXPECT_FALSE(frameJson(lostFrame(2), "map").contains("jump"));
}

TEST(FrameJson, NamesTheMapFrame) {
  const auto json = frameJson(goodFrame(1, 0, 0), "map");
  EXPECT_TRUE(json.contains("map_from_camera"));
}

TEST(SummaryJson, CountsTheAnswersInEachMap) {
  host::Run run;
  run.maps.resize(2);
  run.frames = {goodFrame(1, 0, 0), goodFrame(2, 0, 0), lostFrame(3)};
  for (FrameRecord &frame : run.frames) frame.map = 1;
  const auto json = summaryJson(run, summarize(run));
  EXPECT_EQ(json["maps"][0]["localized"], 0);
  EXPECT_EQ(json["maps"][1]["localized"], 2);
}

TEST(SummaryJson, SaysNullForWhatIsNotKnown) {
  host::Run run;
  run.frames = {lostFrame(1)};
  run.frames[0].has_truth = false;
  const auto json = summaryJson(run, summarize(run));
  EXPECT_TRUE(json["within_5cm_5deg_percent"].is_null());
  EXPECT_TRUE(json["translation_error_m"]["median"].is_null());
  EXPECT_EQ(json["outcomes"]["no consensus"], 1);
  EXPECT_TRUE(nlohmann::json::accept(json.dump()));
}

}  // namespace
}  // namespace sphc::host
