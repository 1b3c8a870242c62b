#include "host/report/aligned_truth.h"

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

TEST(AlignedTruth, BringsTheTruthToTheMapsWorld) {
  host::Run run = elsewhere();
  EXPECT_EQ(summarize(run).good, 0u);
  EXPECT_TRUE(alignTruth(&run));
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
  EXPECT_FALSE(alignTruth(&run));
  EXPECT_EQ(summarize(run).with_truth, 0u);
}

}  // namespace
}  // namespace sphc::host
