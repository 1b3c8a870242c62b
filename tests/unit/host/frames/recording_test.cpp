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

TEST(Recording, WithoutOneThereIsNoCalibration) {
  EXPECT_THAT(test::refusal([] { calibrationOf(nullptr); }), testing::HasSubstr("calibration cannot be read"));
}

}  // namespace
}  // namespace sphc::host
