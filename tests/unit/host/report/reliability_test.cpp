#include "host/report/reliability.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "frames.h"
#include "host/report/json.h"
#include "host/report/reliability_plot.h"
#include "host/report/table.h"

namespace sphc::host {
namespace {

using testing::HasSubstr;
using testing::Not;

std::vector<Graded> graded(double confidence, int correct, int wrong) {
  std::vector<Graded> list(static_cast<size_t>(correct + wrong), {confidence, false});
  for (int i = 0; i < correct; ++i) list[static_cast<size_t>(i)].correct = true;
  return list;
}

std::vector<Graded> joined(std::vector<Graded> a, const std::vector<Graded> &b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST(Reliability, IsNoErrorWhenConfidenceIsTheShareThatIsRight) {
  const auto honest = joined(graded(0.8, 8, 2), graded(0.1, 1, 9));
  EXPECT_NEAR(calibrationError(equalWidthBins(honest)), 0, 1e-12);
}

TEST(Reliability, WeighsBinsByTheirAnswers) {
  const auto mixed = joined(graded(0.9, 5, 5), graded(0.15, 0, 30));  // 0.4 off and 0.15 off
  EXPECT_NEAR(calibrationError(equalWidthBins(mixed)), (10 * 0.4 + 30 * 0.15) / 40, 1e-12);
}

TEST(Reliability, EqualCountBinsHoldEquallyMany) {
  std::vector<Graded> list;
  for (int i = 0; i < 40; ++i) list.push_back({0.9 + 0.001 * i, true});
  EXPECT_EQ(equalWidthBins(list).size(), 1u);
  const auto bins = equalCountBins(list);
  ASSERT_EQ(bins.size(), 10u);
  for (const ReliabilityBin &bin : bins) EXPECT_EQ(bin.count, 4u);
  EXPECT_LT(bins.front().confidence, bins.back().confidence);
}

TEST(Reliability, TakesTheEndsAndWhatIsBeyondThem) {
  const auto bins = equalWidthBins({{1, true}, {0, false}, {7, true}, {-7, false}});
  ASSERT_EQ(bins.size(), 2u);
  EXPECT_EQ(bins[0].count, 2u);
}

TEST(Reliability, OfNothingIsNotKnown) {
  EXPECT_TRUE(std::isnan(calibrationError(equalWidthBins({}))));
  EXPECT_TRUE(std::isnan(calibrationError(equalCountBins({}))));
}

class ReliabilityOfRun : public testing::Test {
 protected:
  void SetUp() override {
    for (uint32_t i = 0; i < 8; ++i) run_.frames.push_back(goodFrame(i, i < 6 ? 0.01 : 0.2, 0.1));
    run_.frames.push_back(lostFrame(8));
  }
  void tellConfidence() {
    for (FrameRecord &frame : run_.frames) frame.confidence = 0.95;
  }
  host::Run run_;
};

TEST_F(ReliabilityOfRun, CountsLocalizedFramesWithTruth) {
  tellConfidence();
  run_.frames[0].has_truth = false;
  const auto list = gradedFrames(run_);
  ASSERT_EQ(list.size(), 7u);
  EXPECT_EQ(std::count_if(list.begin(), list.end(), [](const Graded &g) { return g.correct; }), 5);
}

TEST_F(ReliabilityOfRun, IsDrawnAndToldWhereThereIsAConfidence) {
  tellConfidence();
  EXPECT_THAT(reliability(run_).script, HasSubstr("plot $counts"));
  EXPECT_THAT(reliability(run_).caption, HasSubstr("0.200 over 8 poses"));
  EXPECT_THAT(tableText(tableRows(run_, summarize(run_))), HasSubstr("calibration error of confidence"));
  EXPECT_NEAR(summaryJson(run_, summarize(run_))["calibration_error"]["equal_width"].get<double>(), 0.2, 1e-12);
  EXPECT_EQ(frameJson(run_.frames[0], "world")["confidence"].get<double>(), 0.95);
  EXPECT_FALSE(frameJson(run_.frames[8], "world").contains("confidence"));
}

TEST_F(ReliabilityOfRun, IsLeftOutWhereThereIsNone) {
  EXPECT_EQ(reliability(run_).script, "");
  EXPECT_THAT(tableText(tableRows(run_, summarize(run_))), Not(HasSubstr("calibration")));
  EXPECT_TRUE(summaryJson(run_, summarize(run_))["calibration_error"].is_null());
}

}  // namespace
}  // namespace sphc::host
