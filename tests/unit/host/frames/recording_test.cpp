#include "host/frames/recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/contract/tiny_recording.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

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
  const test::TempFolder folder;
  contract::writeTinyRecording(folder.path().string(), 3);
  folder.write("depth.txt", "5.0 depth/000000.png\n6.0 depth/000001.png\n");
  RecordingOptions options;
  options.folder = folder.path().string();
  EXPECT_THAT(test::refusal([&] { openRecording(options); }),
              testing::AllOf(testing::HasSubstr("none of 2 depth images"), testing::HasSubstr("3 colour images")));
}

// Colour comes twice as often as depth, so each depth image is that of two frames.
TEST(Recording, AChosenFrameKeepsTheDepthThatItHasAmongAll) {
  const test::TempFolder folder;
  contract::writeTinyRecording(folder.path().string(), 6);
  folder.write("rgb.txt", "1.00 rgb/000000.png\n1.01 rgb/000001.png\n1.02 rgb/000002.png\n1.03 rgb/000003.png\n");
  folder.write("depth.txt", "1.00 depth/000000.png\n1.02 depth/000002.png\n");
  RecordingOptions options;
  options.folder = folder.path().string();
  const auto all = openRecording(options);
  ASSERT_EQ(all->frameCount(), 4u);
  options.first = 1;
  options.step = 2;
  const auto odd = openRecording(options);
  ASSERT_EQ(odd->frameCount(), 2u);
  for (uint32_t i = 0; i < 2; ++i) EXPECT_EQ(odd->depthOf(i).time_ns, all->depthOf(2 * i + 1).time_ns);
  options.last = 1;
  EXPECT_EQ(openRecording(options)->frameCount(), 1u);
}

// Frames at 1.00, 1.01 and 1.02 s.
TEST(Recording, ItIsSaidWhyNoPoseIsOfAFrame) {
  const test::TempFolder folder;
  contract::writeTinyRecording(folder.path().string(), 3);
  folder.write("rgb.txt", "1.00 rgb/000000.png\n1.01 rgb/000001.png\n1.02 rgb/000002.png\n");
  folder.write("depth.txt", "1.00 depth/000000.png\n1.01 depth/000001.png\n1.02 depth/000002.png\n");
  RecordingOptions options;
  options.folder = folder.path().string();
  const auto why = [&](const char *poses) {
    folder.write("groundtruth.txt", poses);
    const auto reader = openRecording(options);
    return ofOtherTimes(*reader, reader->recording().poses);
  };
  EXPECT_THAT(why("5 0 0 0 0 0 0 1\n5.1 0 0 0 0 0 0 1\n"), testing::HasSubstr("in seconds of one clock?"));
  const char *const seldom = "0.98 0 0 0 0 0 0 1\n1.047 0 0 0 0 0 0 1\n";
  EXPECT_THAT(why(seldom),
              testing::HasSubstr("they are 67 ms apart there, and are interpolated over at most 50 ms; "
                                 "--pose-gap-ms takes more"));
  EXPECT_THAT(why("0 0 0 0 0 0 0 1\n3 0 0 0 0 0 0 1\n"),
              testing::HasSubstr("they are 3000 ms apart there, and are interpolated over at most 50 ms; record"));
  folder.write("groundtruth.txt", seldom);
  options.pose_gap_ms = 67;
  EXPECT_TRUE(openRecording(options)->worldFromCamera(1));
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
