#include "host/import/rgbd_import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "host/frames/recording.h"
#include "host/import/near_duplicates.h"
#include "tests/contract/tiny_recording.h"
#include "tests/support/refusal.h"
#include "tests/support/session.h"
#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

using testing::HasSubstr;

class RgbdImportTest : public testing::Test {
 protected:
  void SetUp() override { contract::writeTinyRecording(walk(), 3); }
  std::string walk() const { return folder_ / "walk"; }
  std::string refusal() const {
    RecordingOptions options;
    options.folder = walk();
    RgbdImportSummary summary;
    return test::refusal([&] { importRgbd({{openRecording(options).get()}}, {}, {}, &summary); });
  }
  // The poses of all frames; none where `pose` is empty.
  void setPoses(const std::string &pose) const {
    std::ofstream file(walk() + "/groundtruth.txt");
    for (const char *time : {"1305031102.175304123", "1305031102.185304123", "1305031102.195304123"})
      if (!pose.empty()) file << time << " " << pose << "\n";
  }

  test::TempFolder folder_;
};

TEST_F(RgbdImportTest, TakesARecordingWithPoses) { EXPECT_EQ(refusal(), ""); }

TEST_F(RgbdImportTest, OnePoseForAllFramesIsRefused) {
  setPoses("1 2 3 0 0 0 1");
  EXPECT_THAT(refusal(), HasSubstr("all 3 poses are the same"));
}

TEST_F(RgbdImportTest, NoPosesAreNamedAsTheCause) {
  setPoses("");
  EXPECT_THAT(refusal(), HasSubstr("a map needs poses"));
}

TEST_F(RgbdImportTest, PosesOfOtherTimesAreNamedAsTheCause) {
  std::ofstream(walk() + "/groundtruth.txt") << "1.5 0 0 0 0 0 0 1\n2.5 1 0 0 0 0 0 1\n";
  EXPECT_THAT(refusal(), HasSubstr("none of 2 poses is of the time of a frame"));
}

TEST_F(RgbdImportTest, PosesFromElsewhereStandForTheRecordings) {
  setPoses("");
  RecordingOptions recording;
  recording.folder = walk();
  const auto poses = [](int64_t time_ns) {
    const auto i = static_cast<uint32_t>((time_ns - contract::kFirstNs) / contract::kPeriodNs);
    return i == 1 ? std::nullopt : std::make_optional(contract::tinyPose(i));
  };
  RgbdImportSummary summary;
  importRgbd({{openRecording(recording).get(), {}, poses}}, {}, {}, &summary);
  EXPECT_EQ(summary.frames_used, 2u);
  EXPECT_EQ(summary.frames_without_pose, 1u);
}

// A hall is no sensor that is covered.  Frame i shows what is i to i + 0.7 metres away.
TEST_F(RgbdImportTest, FramesAreJudgedByTheDepthsThatAreUsed) {
  const std::string hall = folder_ / "hall";
  contract::writeTinyRecording(hall, 10);
  RecordingOptions recording;
  recording.folder = hall;
  const auto out_of_range = [&](double depth_max_m) {
    RgbdImportOptions options;
    options.depth_max_m = depth_max_m;
    RgbdImportSummary summary;
    importRgbd({{openRecording(recording).get()}}, options, {}, &summary);
    return summary.frames_with_fault.of(kDepthRange);
  };
  EXPECT_EQ(out_of_range(6), 4u);
  EXPECT_EQ(out_of_range(20), 0u);
}

TEST_F(RgbdImportTest, ImagesThatAreCutAreNamedAsTheCause) {
  for (const auto &image : std::filesystem::directory_iterator(walk() + "/rgb"))
    std::filesystem::resize_file(image.path(), 20);
  EXPECT_THAT(refusal(), HasSubstr("not one frame can be read"));
  EXPECT_THAT(refusal(), HasSubstr(".png"));
}

// The test room, seen by a camera that passes it, with depth so much later than colour.
class LateDepthTest : public testing::Test {
 protected:
  static constexpr int64_t kStepNs = 30000000, kFirstNs = 1000000000;
  static constexpr uint32_t kFrames = 6;
  static constexpr double kFaster = 4;  // viewpoints a step

  PointModel import(int64_t later_ns, bool is_told, int64_t poses_every_ns, RgbdImportSummary *summary,
                    const DepthCalibration &depth = {}) const {
    const std::string folder = folder_ / ("walk" + std::to_string(++walks_));
    const sphc_localizer_config config = test::sceneConfig();
    sphc_recording_writer *writer = nullptr;
    sphc_message message = {};
    EXPECT_EQ(sphc_recording_create(folder.c_str(), &config.rig, &writer, &message), SPHC_OK) << message.text;
    for (uint32_t i = 0; i < kFrames; ++i) {
      const int64_t time_ns = kFirstNs + i * kStepNs;
      const test::SceneImages now = imagesAt(config, time_ns), then = imagesAt(config, time_ns + later_ns);
      const auto made = test::sceneFrame(config, 0);
      sphc_localizer_frame frame = made->frame;
      frame.sequence = i;
      frame.color.data = now.gray.data();
      frame.depth.data = then.depth_mm.data();
      frame.color_time_ns = time_ns;
      frame.depth_time_ns = time_ns + (is_told ? later_ns : 0);
      EXPECT_EQ(sphc_recording_add_frame(writer, &frame, &message), SPHC_OK) << message.text;
    }
    for (int64_t after_ns = 0; after_ns <= kFrames * kStepNs; after_ns += poses_every_ns) {
      const sphc_rigid pose = rigidToC(colorFromWorldAt(kFirstNs + after_ns).inverse());
      EXPECT_EQ(sphc_recording_add_pose(writer, kFirstNs + after_ns, &pose, &message), SPHC_OK) << message.text;
    }
    EXPECT_EQ(sphc_recording_close(&writer, &message), SPHC_OK) << message.text;
    RecordingOptions options;
    options.folder = folder;
    return importRgbd({{openRecording(options).get(), {}, {}, depth}}, {}, {}, summary);
  }
  // From where the same points are in another model, the median.
  static double offM(const PointModel &model, const PointModel &truth) {
    std::vector<double> off_m;
    for (const ModelPoint &point : model.points)
      for (const ModelPoint &same : truth.points)
        if (descriptorDistance(point.descriptor, same.descriptor) == 0)
          off_m.push_back((point.position_m - same.position_m).norm());
    EXPECT_GT(off_m.size(), 50u);
    std::sort(off_m.begin(), off_m.end());
    return off_m.empty() ? 0 : off_m[off_m.size() / 2];
  }

 private:
  static Rigid colorFromWorldAt(int64_t time_ns) {
    return test::sceneViewpoint(kFaster * static_cast<double>(time_ns - kFirstNs) / kStepNs);
  }
  static test::SceneImages imagesAt(const sphc_localizer_config &config, int64_t time_ns) {
    return test::renderScene(config.rig.color_camera, config.rig.depth_camera, colorFromWorldAt(time_ns),
                             rigidFromC(config.rig.color_from_depth));
  }

  test::TempFolder folder_;
  mutable int walks_ = 0;
};

TEST_F(LateDepthTest, IsTakenFromWhereItsCameraWas) {
  RgbdImportSummary summary;
  const PointModel truth = import(0, true, kStepNs, &summary);
  const double untold_m = offM(import(12000000, false, kStepNs, &summary), truth);
  EXPECT_EQ(summary.frames_apart, 0u);
  const double told_m = offM(import(12000000, true, kStepNs, &summary), truth);
  EXPECT_EQ(summary.frames_apart, 0u);
  EXPECT_GT(untold_m, 0.03) << "the camera moves too little to tell";
  EXPECT_LT(told_m, 0.003);
  EXPECT_TRUE(framesLeftOut(summary).empty());
}

// The images have none, so points are off by what is told, along rays that are at most a fifth longer than their
// depth.
TEST_F(LateDepthTest, ABiasThatIsKnownIsTakenOut) {
  RgbdImportSummary summary;
  const PointModel truth = import(0, true, kStepNs, &summary);
  DepthCalibration depth;
  depth.mean = {0.05, 0};
  EXPECT_NEAR(offM(import(0, true, kStepNs, &summary, depth), truth), 0.055, 0.006);
  depth.mean = {0, 0.05};
  depth.mid_m = 100;
  EXPECT_GT(offM(import(0, true, kStepNs, &summary, depth), truth), 1);
}

TEST_F(LateDepthTest, ThatNoPosesTellOfIsNamed) {
  RgbdImportSummary summary;
  import(12000000, true, 2 * kStepNs, &summary);
  EXPECT_EQ(summary.frames_used, kFrames / 2);
  EXPECT_EQ(summary.frames_apart, kFrames / 2);
  EXPECT_THAT(framesLeftOut(summary), testing::Contains(HasSubstr("3 frames was taken more than 10 ms")));
  import(8000000, true, 2 * kStepNs, &summary);
  EXPECT_EQ(summary.frames_apart, 0u);
}

}  // namespace
}  // namespace sphc::host
