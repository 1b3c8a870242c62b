#include "host/mapping/walk.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "host/frames/recording.h"
#include "spotted_images.h"
#include "tests/contract/tiny_recording.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

using testing::HasSubstr;

class WalkTest : public testing::Test {
 protected:
  void SetUp() override { contract::writeTinyRecording(folder(), 3); }
  std::string folder() const { return folder_ / "walk"; }
  Walk read() const {
    RecordingOptions options;
    options.folder = folder();
    FrameReaderOptions frames;
    frames.depth_min_m = 0.0;
    return readWalk(openRecording(options).get(), frames, {});
  }
  void cutImages() const {
    for (const auto &image : std::filesystem::directory_iterator(folder() + "/rgb"))
      std::filesystem::resize_file(image.path(), 20);
  }
  test::TempFolder folder_;
};

// Pixels of 48 x 32 have next to no keypoints, which is what the person is told.
TEST_F(WalkTest, ImagesThatShowNothingAreRefused) {
  EXPECT_THAT(test::refusal([this] { read(); }),
              testing::AllOf(HasSubstr("do the images show something"), HasSubstr("color_from_depth"),
                             HasSubstr("spherecloud doctor")));
}

TEST_F(WalkTest, ImagesThatAreCutAreNamedAsTheCause) {
  cutImages();
  const std::string why = test::refusal([this] { read(); });
  EXPECT_THAT(why, HasSubstr("not one frame can be read"));
  EXPECT_THAT(why, HasSubstr(".png"));
}

TEST(WalkKeyframes, LieFartherApartInALongWalk) {
  EXPECT_EQ(keyframeShift(1), 0.02);
  EXPECT_EQ(keyframeShift(300), 0.02);
  EXPECT_NEAR(keyframeShift(600), 0.04, 1e-12);
  EXPECT_EQ(keyframeShift(9000), 0.2);
}

// A frame that shows what the one before it did takes its pose from it.
TEST(SpottedWalkTest, FramesThatShowTheSameFollowTheirKeyframe) {
  const test::TempFolder folder;
  const sphc_rig rig = spottedRig();
  sphc_recording_writer *writer = nullptr;
  ASSERT_EQ(sphc_recording_create((folder / "wall").c_str(), &rig, &writer, nullptr), SPHC_OK);
  uint32_t sequence = 0;
  for (const int shift_px : {0, 2, 40, 41}) {
    const SpottedImages images(400, 128, 2000, shift_px);
    const sphc_localizer_frame frame = images.frame(sequence, 1000000000 + 100000000 * int64_t{sequence});
    EXPECT_EQ(sphc_recording_add_frame(writer, &frame, nullptr), SPHC_OK);
    ++sequence;
  }
  ASSERT_EQ(sphc_recording_close(&writer, nullptr), SPHC_OK);
  RecordingOptions options;
  options.folder = folder / "wall";
  const Walk walk = readWalk(openRecording(options).get(), {}, {});
  ASSERT_EQ(walk.keyframes.size(), 2u);
  EXPECT_EQ(walk.keyframes[1].index, 2u);
  ASSERT_EQ(walk.followers.size(), 2u);
  EXPECT_EQ(walk.followers[0].index, 1u);
  EXPECT_EQ(walk.followers[1].keyframe, 1u);
  // 2 px to the right: the camera went 2 / 250 of 2 m to the left.
  EXPECT_NEAR(walk.followers[0].keyframe_from_frame.translation_m.x(), -0.016, 0.006);
}

}  // namespace
}  // namespace sphc::host
