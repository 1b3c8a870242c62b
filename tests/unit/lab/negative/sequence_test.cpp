#include "lab/negative/sequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/contract/tiny_recording.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

constexpr uint32_t kFrames = kSequenceFrames + 5;

class SequenceTest : public testing::Test {
 protected:
  SequenceTest() { contract::writeTinyRecording(folder_.path().string(), kFrames); }

  test::TempFolder folder_;
};

TEST_F(SequenceTest, FramesAreAllOrSoManySpreadOverTheRecording) {
  recording::RecordingReader reader(folder_.path());
  EXPECT_EQ(readFrames(&reader).shots.size(), kFrames);
  const Sequence some = readFrames(&reader, 7);
  ASSERT_EQ(some.shots.size(), 7u);
  for (uint32_t i = 0; i < 7; ++i) EXPECT_EQ(some.shots[i].color_time_ns, reader.colorOf(5 * i).time_ns);
}

TEST_F(SequenceTest, SequencesAreOfOneLength) {
  recording::RecordingReader reader(folder_.path());
  const std::vector<Sequence> sequences = readSequences(&reader, 9);
  ASSERT_EQ(sequences.size(), 1u);
  EXPECT_EQ(sequences[0].shots.size(), kSequenceFrames);
}

TEST_F(SequenceTest, FramesThatCannotBeReadAreLeftOut) {
  folder_.write("rgb/000003.png", "no image");
  recording::RecordingReader reader(folder_.path());
  EXPECT_EQ(readFrames(&reader).shots.size(), kFrames - 1);
}

TEST_F(SequenceTest, ARecordingWithoutAReadableFrameIsRefused) {
  for (uint32_t i = 0; i < kFrames; ++i)
    folder_.write((i < 10 ? "depth/00000" : "depth/0000") + std::to_string(i) + ".png", "no image");
  recording::RecordingReader reader(folder_.path());
  const auto names_one =
      testing::AllOf(testing::HasSubstr("not one frame can be read"), testing::HasSubstr("depth/0000"));
  EXPECT_THAT(test::refusal([&] { readFrames(&reader); }), names_one);
  EXPECT_THAT(test::refusal([&] { readSequences(&reader, 4); }), names_one);
}

}  // namespace
}  // namespace sphc::host
