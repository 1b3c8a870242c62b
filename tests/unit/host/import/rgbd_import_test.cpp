#include "host/import/rgbd_import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "host/frames/recording.h"
#include "tests/contract/temp_folder.h"
#include "tests/contract/tiny_recording.h"

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
    try {
      importRgbd({{openRecording(options).get()}}, {}, {}, &summary);
    } catch (const std::runtime_error &error) {
      return error.what();
    }
    return "";
  }
  // The poses of all frames; none where `pose` is empty.
  void setPoses(const std::string &pose) const {
    std::ofstream file(walk() + "/groundtruth.txt");
    for (const char *time : {"1305031102.175304123", "1305031102.185304123", "1305031102.195304123"})
      if (!pose.empty()) file << time << " " << pose << "\n";
  }

  contract::TempFolder folder_;
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

TEST_F(RgbdImportTest, PosesFromElsewhereStandForTheRecordings) {
  setPoses("");
  RecordingOptions recording;
  recording.folder = walk();
  const auto poses = [](uint32_t i) { return i == 1 ? std::nullopt : std::make_optional(contract::tinyPose(i)); };
  RgbdImportSummary summary;
  importRgbd({{openRecording(recording).get(), {}, poses}}, {}, {}, &summary);
  EXPECT_EQ(summary.frames_used, 2u);
  EXPECT_EQ(summary.frames_without_pose, 1u);
}

TEST_F(RgbdImportTest, ImagesThatAreCutAreNamedAsTheCause) {
  for (const auto &image : std::filesystem::directory_iterator(walk() + "/rgb"))
    std::filesystem::resize_file(image.path(), 20);
  EXPECT_THAT(refusal(), HasSubstr("not one frame can be read"));
  EXPECT_THAT(refusal(), HasSubstr(".png"));
}

}  // namespace
}  // namespace sphc::host
