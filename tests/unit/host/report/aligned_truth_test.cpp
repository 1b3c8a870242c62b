#include "host/report/aligned_truth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "frames.h"
#include "runtime/geometry/rigid.h"

namespace sphc::host {
namespace {

// Twenty right poses, one that is 2 m off and one frame that was not found, in a world that lies elsewhere.
host::Run elsewhere() {
  host::Run run;
  for (uint32_t i = 0; i < 20; ++i) run.frames.push_back(goodFrame(i, 0.001, 0.1));
  run.frames.push_back(goodFrame(20, 2, 0));
  run.frames.push_back(lostFrame(21));
  const Rigid other = {rotationFromVector(Vector3(0.3, -1, 2)), Vector3(4, 5, -6)};
  for (FrameRecord &frame : run.frames) {
    frame.truth_base_from_camera = rigidToC(other * rigidFromC(frame.truth_base_from_camera));
    judge(&frame);
  }
  return run;
}

// The same, from frame 10 in a second map, whose world lies elsewhere too.
host::Run elsewhereInTwoMaps() {
  host::Run run = elsewhere();
  run.maps.resize(2);
  const Rigid second_from_first = {rotationFromVector(Vector3(-1, 0.2, 0.5)), Vector3(-3, 7, 1)};
  for (size_t i = 10; i < run.frames.size(); ++i) {
    FrameRecord &frame = run.frames[i];
    frame.map = frame.localized ? 1 : SPHC_MAP_NONE;
    frame.base_from_camera = rigidToC(second_from_first * rigidFromC(frame.base_from_camera));
  }
  return run;
}

TEST(AlignedTruth, BringsTheTruthToTheMapsWorld) {
  host::Run run = elsewhere();
  EXPECT_EQ(summarize(run).good, 0u);
  EXPECT_TRUE(alignTruth(&run).empty());
  const Summary summary = summarize(run);
  EXPECT_EQ(summary.good, 20u);
  EXPECT_EQ(run.aligned_frames, 20u);
  EXPECT_LT(summary.translation_m.median, 0.002);
}

TEST(AlignedTruth, APoseThatIsWrongStaysWrong) {
  host::Run run = elsewhere();
  alignTruth(&run);
  EXPECT_EQ(summarize(run).wrong, 1u);
  EXPECT_NEAR(run.frames[20].translation_error_m, 2, 0.01);
}

TEST(AlignedTruth, OfTwoPosesTheTruthIsDropped) {
  host::Run run = elsewhere();
  run.frames.resize(2);
  alignTruth(&run);
  EXPECT_EQ(run.aligned_frames, 0u);
  EXPECT_EQ(summarize(run).with_truth, 0u);
}

TEST(AlignedTruth, EachMapHasAWorldOfItsOwn) {
  host::Run run = elsewhereInTwoMaps();
  EXPECT_TRUE(alignTruth(&run).empty());
  const Summary summary = summarize(run);
  EXPECT_EQ(summary.good, 20u);
  EXPECT_EQ(summary.wrong, 1u);
  EXPECT_EQ(summary.with_truth, 22u) << "a frame that was not found counts as before";
  EXPECT_EQ(run.aligned_frames, 20u);
  EXPECT_EQ(basesOfAnswers(run), 2u);
}

TEST(AlignedTruth, AMapOfTwoPosesIsNamedAndItsTruthIsDropped) {
  host::Run run = elsewhereInTwoMaps();
  for (size_t i = 12; i <= 20; ++i) run.frames[i] = lostFrame(static_cast<uint32_t>(i));
  EXPECT_THAT(alignTruth(&run), testing::ElementsAre(1u));
  const Summary summary = summarize(run);
  EXPECT_EQ(summary.good, 10u);
  EXPECT_EQ(summary.wrong, 0u);
  EXPECT_EQ(summary.with_truth, 20u) << "all but the two";
}

}  // namespace
}  // namespace sphc::host
