#include "host/frames/recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/refusal.h"

namespace sphc::host {
namespace {

TEST(Recording, OneThatIsNotThereIsNamed) {
  RecordingOptions options;
  options.folder = "/nonexistent";
  EXPECT_THAT(
      test::refusal([&] { openRecording(options); }),
      testing::AllOf(testing::StartsWith("cannot open the recording: "), testing::HasSubstr("/nonexistent")));
}

TEST(Recording, AStepOfZeroChoosesNothing) {
  RecordingOptions options;
  options.step = 0;
  EXPECT_THAT(test::refusal([&] { openRecording(options); }), testing::HasSubstr("--step"));
}

}  // namespace
}  // namespace sphc::host
