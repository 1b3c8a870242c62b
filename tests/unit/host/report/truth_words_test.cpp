#include "host/report/truth_words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "frames.h"

namespace sphc::host {
namespace {

using testing::HasSubstr;

host::Run sureRun(double error_m) {
  host::Run run;
  run.maps.resize(1);
  for (uint32_t i = 0; i < 8; ++i) {
    run.frames.push_back(goodFrame(i, error_m, 0.1));
    run.frames.back().confidence = 0.99;
  }
  return run;
}

std::string doubtOf(const host::Run &run) { return doubtOfTruth(run, summarize(run)); }

TEST(DoubtOfTruth, IsOfSurePosesThatAreFarOff) {
  EXPECT_EQ(doubtOf(sureRun(0.01)), "");
  host::Run far = sureRun(2.6);
  EXPECT_THAT(doubtOf(far), HasSubstr("8 of 8 poses are sure and far from the recording's: was the map made by"));
  far.aligned_frames = 8;
  EXPECT_THAT(doubtOf(far), HasSubstr("no rigid alignment brings the two together"));
  for (FrameRecord &frame : far.frames) frame.confidence = 0.4;
  EXPECT_EQ(doubtOf(far), "");
}

TEST(AlignmentWords, AreOfAlignedRunsAlone) {
  host::Run run = sureRun(0.01);
  EXPECT_EQ(alignmentWords(run), "");
  run.aligned_frames = 8;
  EXPECT_EQ(alignmentWords(run),
            "the errors are what a rigid alignment of the recording's poses to the map leaves (--align)");
  run.maps.resize(2);
  EXPECT_THAT(alignmentWords(run), HasSubstr("to each map leaves"));
}

}  // namespace
}  // namespace sphc::host
