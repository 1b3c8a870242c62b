#include "host/frames/recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/contract/temp_folder.h"
#include "tests/contract/tiny_recording.h"
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

TEST(Recording, ColourAndDepthThatNeverMeetAreNamedAsTheCause) {
  const contract::TempFolder folder;
  contract::writeTinyRecording(folder.path().string(), 3);
  folder.write("depth.txt", "5.0 depth/000000.png\n6.0 depth/000001.png\n");
  RecordingOptions options;
  options.folder = folder.path().string();
  EXPECT_THAT(test::refusal([&] { openRecording(options); }),
              testing::AllOf(testing::HasSubstr("none of 2 depth images"), testing::HasSubstr("3 colour images")));
}

TEST(Recording, AStepOfZeroChoosesNothing) {
  RecordingOptions options;
  options.step = 0;
  EXPECT_THAT(test::refusal([&] { openRecording(options); }), testing::HasSubstr("--step"));
}

TEST(Recording, ASelectionIsSaidInWords) {
  RecordingOptions options;
  EXPECT_EQ(describeSelection(options), "all frames");
  options.step = 3;
  EXPECT_EQ(describeSelection(options), "all frames, every 3rd");
  options.first = 100;
  EXPECT_EQ(describeSelection(options), "frames 100 to the end, every 3rd");
  options.last = 100;
  EXPECT_EQ(describeSelection(options), "frame 100");
}

}  // namespace
}  // namespace sphc::host
