#include "host/report/statistics.h"

#include <gtest/gtest.h>

#include "frames.h"

namespace sphc::host {
namespace {

TEST(Percentile, IsLinearBetweenRanks) {
  EXPECT_DOUBLE_EQ(percentile({4, 1, 3, 2}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(percentile({10, 20, 30, 40, 50}, 0.9), 46);
  EXPECT_DOUBLE_EQ(percentile({7}, 0.9), 7);
  EXPECT_DOUBLE_EQ(percentile({1, 2, 3}, 0), 1);
  EXPECT_DOUBLE_EQ(percentile({1, 2, 3}, 1), 3);
}

TEST(Percentile, OfNothingIsNotANumber) { EXPECT_TRUE(std::isnan(percentile({}, 0.5))); }

TEST(PoseError, IsTheAngleAndTheDistance) {
  EXPECT_NEAR(rotationErrorDeg(poseAt(0, 0, 0, 10), poseAt(5, 5, 5, 13)), 3, 1e-9);
  EXPECT_NEAR(translationErrorM(poseAt(1, 2, 3), poseAt(1, 5, 7)), 5, 1e-12);
}

TEST(PoseError, KeepsTinyAnglesAndFoldsLargeOnes) {
  EXPECT_NEAR(rotationErrorDeg(poseAt(0, 0, 0, 0), poseAt(0, 0, 0, 1e-6)), 1e-6, 1e-12);
  EXPECT_NEAR(rotationErrorDeg(poseAt(0, 0, 0, 0), poseAt(0, 0, 0, 350)), 10, 1e-9);
}

TEST(PoseError, DoesNotSeeTheQuaternionsSign) {
  sphc_rigid turned = poseAt(0, 0, 0, 30);
  for (double &q : turned.q_wxyz) q = -q;
  EXPECT_NEAR(rotationErrorDeg(poseAt(0, 0, 0, 30), turned), 0, 1e-9);
}

TEST(Summary, CountsSharesOfAllFramesAndErrorsOfLocalizedOnes) {
  host::Run run;
  run.frames = {goodFrame(1, 0.01, 0.1), goodFrame(2, 0.03, 0.2), goodFrame(3, 0.20, 0.3), lostFrame(4)};
  const Summary summary = summarize(run);
  EXPECT_EQ(summary.frames, 4u);
  EXPECT_EQ(summary.localized, 3u);
  EXPECT_EQ(summary.with_truth, 4u);
  EXPECT_EQ(summary.good, 2u);
  EXPECT_NEAR(summary.translation_m.median, 0.03, 1e-9);
  EXPECT_NEAR(summary.translation_m.worst, 0.20, 1e-9);
  EXPECT_NEAR(summary.rotation_deg.p90, 0.28, 1e-6);
  EXPECT_EQ(summary.outcomes[SPHC_OUTCOME_LOCALIZED], 3u);
  EXPECT_EQ(summary.outcomes[SPHC_OUTCOME_NO_CONSENSUS], 1u);
}

TEST(Summary, FiveDegreesCountToo) {
  EXPECT_TRUE(isGood(goodFrame(1, 0.04, 4.9)));
  EXPECT_FALSE(isGood(goodFrame(1, 0.04, 5.1)));
  EXPECT_FALSE(isGood(goodFrame(1, 0.06, 0.1)));
}

TEST(Summary, WrongIsGivenOutAndFarFromTheTruth) {
  host::Run run;
  run.frames = {goodFrame(1, 0.24, 9.9), goodFrame(2, 0.26, 0), goodFrame(3, 0.01, 10.1), lostFrame(4)};
  run.frames.push_back(goodFrame(5, 3, 90));
  run.frames.back().has_truth = false;
  EXPECT_EQ(summarize(run).wrong, 2u);
}

TEST(Summary, WorstFramesAreThoseFurthestOffInEitherMeasure) {
  host::Run run;
  run.frames = {goodFrame(1, 0.10, 0), goodFrame(2, 0.02, 20), lostFrame(3), goodFrame(4, 0.30, 1),
                goodFrame(5, 0, 0)};
  EXPECT_EQ(worstFrames(run, 3), (std::vector<size_t>{1, 3, 0}));
  EXPECT_EQ(worstFrames(run, 9).size(), 4u);
  EXPECT_TRUE(worstFrames(host::Run(), 3).empty());
}

TEST(Summary, OfAnEmptyRunHasNoErrors) {
  const Summary summary = summarize(host::Run());
  EXPECT_EQ(summary.frames, 0u);
  EXPECT_TRUE(std::isnan(summary.translation_m.median));
  EXPECT_DOUBLE_EQ(percent(0, 0), 0);
}

}  // namespace
}  // namespace sphc::host
