#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "host/recording/failure.h"
#include "host/recording/foreign/stray_text.h"
#include "host/recording/recording_reader.h"
#ifdef SPHC_TEST_LIBAVFORMAT
#include "tests/support/mp4_encoder.h"
#endif
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace sphc::contract {
namespace {

using recording::Failure;
using recording::RecordingReader;
using test::refusal;
using ::testing::HasSubstr;

constexpr uint32_t kFrames = 6;
constexpr int kColorCols = 128, kColorRows = 96, kDepthCols = 32, kDepthRows = 24;
constexpr const char *kHeader = "timestamp, frame, x, y, z, qx, qy, qz, qw\n";

std::string numbered(const char *format, uint32_t number) {
  char name[64];
  std::snprintf(name, sizeof name, format, number);
  return name;
}

// Every frame has a grey of its own, brighter in the upper half.
cv::Mat strayColor(uint32_t i) {
  cv::Mat image(kColorRows, kColorCols, CV_8UC3, cv::Scalar::all(20 + 20 * i));
  image.rowRange(0, kColorRows / 2) += cv::Scalar::all(60);
  return image;
}

cv::Mat strayDepth(uint32_t i) { return cv::Mat(kDepthRows, kDepthCols, CV_16UC1, cv::Scalar(1000 + i)); }

// Columns of low, medium and high confidence.
cv::Mat strayConfidence() {
  cv::Mat image(kDepthRows, kDepthCols, CV_8UC1, cv::Scalar(2));
  image.colRange(0, 4) = 0;
  image.colRange(4, 8) = 1;
  return image;
}

class StrayScanner : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string odometry = kHeader;
    for (uint32_t i = 0; i < kFrames; ++i) {
      odometry += numbered("100.%03u", 16 * i) + numbered(", %06u", i) + numbered(", 0.%u, 1, 2", i) +
                  ", 0.7071067811865476, 0, 0, 0.7071067811865476\n";
      writeImage(numbered("rgb/%06u.png", i), strayColor(i));
      writeImage(numbered("depth/%06u.png", i), strayDepth(i));
      writeImage(numbered("confidence/%06u.png", i), strayConfidence());
    }
    folder_.write("odometry.csv", odometry);
    folder_.write("camera_matrix.csv", "100.0, 0.0, 66.0\n0.0, 101.0, 47.0\n0.0, 0.0, 1.0\n");
  }

  void writeImage(const std::string &name, const cv::Mat &image) {
    folder_.write(name, "");
    ASSERT_TRUE(cv::imwrite(folder_ / name, image));
  }
  std::string refusalOfOpen() {
    return refusal([&] { RecordingReader reader(folder_.path()); });
  }

  test::TempFolder folder_;
};

TEST_F(StrayScanner, ImagesPosesAndCameras) {
  RecordingReader reader(folder_.path());
  ASSERT_EQ(reader.frameCount(), kFrames);
  const sphc_localizer_frame frame = reader.read(3);
  EXPECT_EQ(frame.color_time_ns, 100048000000);
  EXPECT_EQ(frame.depth_time_ns, frame.color_time_ns);
  EXPECT_EQ(frame.sequence, 3u);
  EXPECT_EQ(static_cast<const uint8_t *>(frame.color.data)[0], 140);
  EXPECT_EQ(reader.calibration().color_camera.params[0], 100);
  EXPECT_EQ(reader.calibration().color_camera.params[3], 47);
  const sphc_camera &depth = reader.calibration().depth_camera;
  EXPECT_EQ(depth.width, 32u);
  EXPECT_DOUBLE_EQ(depth.params[0], 25) << "one camera, a quarter of the size";
  EXPECT_DOUBLE_EQ(depth.params[1], 25.25);
  EXPECT_DOUBLE_EQ(depth.params[2], 16.5);
  EXPECT_DOUBLE_EQ(depth.params[3], 11.75);
  EXPECT_EQ(reader.calibration().depth_unit_m, 0.001);
}

// The app turns ARKit's axes into right, down, forward before it writes: nothing is left to turn here.
TEST_F(StrayScanner, CameraAxesAreOurs) {
  const RecordingReader reader(folder_.path());
  const std::optional<sphc_rigid> pose = reader.worldFromCamera(2);
  ASSERT_TRUE(pose);
  EXPECT_DOUBLE_EQ(pose->q_wxyz[0], 0.7071067811865476);
  EXPECT_DOUBLE_EQ(pose->q_wxyz[1], 0.7071067811865476);
  EXPECT_EQ(pose->t_m[0], 0.2);
  EXPECT_EQ(pose->t_m[2], 2);
}

TEST_F(StrayScanner, AFileThatIsMissingIsNamed) {
  std::filesystem::remove(folder_ / "odometry.csv");
  EXPECT_THAT(refusalOfOpen(), HasSubstr("a recording of StrayScanner without odometry.csv, which has its times"));
  std::filesystem::remove(folder_ / "camera_matrix.csv");
  folder_.write("rgb.mp4", "");
  EXPECT_THAT(refusalOfOpen(), HasSubstr("without odometry.csv"));
}

// With the video's images taken out of it, and the camera in odometry.csv, as newer versions have it.
TEST_F(StrayScanner, FoldersOfImagesTellItToo) {
  std::filesystem::remove(folder_ / "odometry.csv");
  std::filesystem::remove(folder_ / "camera_matrix.csv");
  EXPECT_THAT(refusalOfOpen(), HasSubstr("without odometry.csv"));
  std::filesystem::remove_all(folder_ / "depth");
  EXPECT_THAT(refusalOfOpen(), HasSubstr("without odometry.csv"));
  std::filesystem::remove_all(folder_ / "confidence");
  std::filesystem::create_directory(folder_ / "depth");
  EXPECT_THAT(refusalOfOpen(), HasSubstr("no recording here")) << "other layouts have rgb and depth too";
}

TEST_F(StrayScanner, DepthOfLowConfidenceIsNone) {
  RecordingReader reader(folder_.path());
  const auto *depth = static_cast<const uint16_t *>(reader.read(1).depth.data);
  EXPECT_EQ(depth[3], 0);
  EXPECT_EQ(depth[4], 1001) << "medium";
  EXPECT_EQ(depth[8], 1001);
  std::filesystem::remove(folder_ / "confidence/000001.png");
  EXPECT_THAT(refusal([&] { reader.read(1); }), HasSubstr("its confidence, confidence/000001.png"));
  std::filesystem::remove_all(folder_ / "confidence");
  EXPECT_EQ(static_cast<const uint16_t *>(reader.read(1).depth.data)[3], 1001) << "a recording of no confidences";
}

TEST_F(StrayScanner, AFrameWithoutDepthTakesNoNeighbours) {
  std::filesystem::remove(folder_ / "depth/000002.png");
  RecordingReader reader(folder_.path());
  EXPECT_EQ(reader.recording().color.size(), kFrames);
  ASSERT_EQ(reader.frameCount(), kFrames - 1) << "the next one is 16 ms away, within the tolerance";
  EXPECT_EQ(reader.colorOf(2).sequence, 3u);
  EXPECT_EQ(reader.depthOf(2).sequence, 3u);
}

TEST_F(StrayScanner, CamerasOfFramesGiveTheirMedian) {
  std::string odometry = "timestamp, frame, x, y, z, qx, qy, qz, qw, fx, fy, cx, cy\n";
  for (uint32_t i = 0; i < 3; ++i)
    odometry += numbered("%u.5", i) + numbered(", %06u, 0, 0, 0, 0, 0, 0, 1", i) + numbered(", %u", 110 + i * i) +
                ", 120, 60, 50\n";
  folder_.write("odometry.csv", odometry);
  const RecordingReader reader(folder_.path());
  EXPECT_EQ(reader.calibration().color_camera.params[0], 111);
  EXPECT_EQ(reader.calibration().color_camera.params[1], 120);
}

TEST_F(StrayScanner, AnAbortedLineIsNotThere) {
  folder_.write("odometry.csv", folder_.read("odometry.csv") + "100.2, 0000");
  EXPECT_EQ(RecordingReader(folder_.path()).frameCount(), kFrames);
}

TEST_F(StrayScanner, PosesThatAreNoneAreCounted) {
  folder_.write("odometry.csv", std::string(kHeader) + "1, 0, 0, 0, 0, 0, 0, 0, 0\n2, 1, 0, 0, nan, 0, 0, 0, 1\n");
  const RecordingReader reader(folder_.path());
  EXPECT_EQ(reader.frameCount(), 2u);
  EXPECT_EQ(reader.recording().bad_pose_count, 2u);
  EXPECT_FALSE(reader.worldFromCamera(0));
}

TEST_F(StrayScanner, ACameraInEveryLineNeedsNoMatrix) {
  std::filesystem::remove(folder_ / "camera_matrix.csv");
  EXPECT_THAT(refusalOfOpen(), HasSubstr("camera_matrix.csv"));
  std::istringstream lines(folder_.read("odometry.csv"));
  std::string with_cameras;
  for (std::string line; std::getline(lines, line);)
    with_cameras += line + (with_cameras.empty() ? ", fx, fy, cx, cy\n" : ", 100, 101, 66, 47\n");
  folder_.write("odometry.csv", with_cameras);
  RecordingReader reader(folder_.path());
  EXPECT_EQ(reader.frameCount(), kFrames);
  EXPECT_EQ(reader.calibration().color_camera.params[1], 101);
}

TEST_F(StrayScanner, ACalibrationStandsInForTheMatrix) {
  std::filesystem::remove(folder_ / "camera_matrix.csv");
  EXPECT_THAT(refusalOfOpen(), AllOf(HasSubstr("camera_matrix.csv: is not there"),
                                     HasSubstr("copy that file too, or give a calibration file")));
  recording::ReaderOptions options;
  options.calibration = folder_.write("rig.json", R"({"format": "spherecloud-calibration", "version": 1,
    "pixel_center": 0.5, "depth_unit_m": 0.001,
    "color_camera": {"model": "pinhole", "width": 128, "height": 96, "params": [90, 90, 64, 48]},
    "depth_camera": {"model": "pinhole", "width": 32, "height": 24, "params": [22, 22, 16, 12]},
    "color_from_depth": {"q_wxyz": [1, 0, 0, 0], "t_m": [0, 0, 0]}})");
  RecordingReader reader(folder_.path(), options);
  EXPECT_EQ(reader.calibration().color_camera.params[0], 90);
  ASSERT_EQ(reader.frameCount(), kFrames);
  EXPECT_EQ(static_cast<const uint16_t *>(reader.read(3).depth.data)[8], 1003);
}

TEST_F(StrayScanner, WhatIsWrongIsNamed) {
  const std::string odometry = folder_.read("odometry.csv");
  folder_.write("odometry.csv", "timestamp, frame, x\n");
  EXPECT_THAT(refusalOfOpen(), HasSubstr("odometry.csv, line 1: no column \"y\""));
  folder_.write("odometry.csv", kHeader);
  EXPECT_THAT(refusalOfOpen(), HasSubstr("no line of a frame"));
  folder_.write("odometry.csv", std::string(kHeader) + "1, 0, 0, 0, 0, 0, 0, 1\n");
  EXPECT_THAT(refusalOfOpen(), HasSubstr("line 2: expected a number"));
  folder_.write("odometry.csv", std::string(kHeader) + "2, 0, 0, 0, 0, 0, 0, 0, 1\n1, 1, 0, 0, 0, 0, 0, 0, 1\n");
  EXPECT_THAT(refusalOfOpen(), HasSubstr("line 3: time or frame"));
  folder_.write("odometry.csv", odometry);
  folder_.write("camera_matrix.csv", "1, 0\n");
  EXPECT_THAT(refusalOfOpen(), HasSubstr("camera_matrix.csv, line 1"));
  folder_.write("camera_matrix.csv", "0, 0, 60\n0, 100, 40\n0, 0, 1\n");
  EXPECT_THAT(refusalOfOpen(), HasSubstr("its camera: "));
  folder_.write("camera_matrix.csv", "100, 0, 60\n0, 100, 40\n0, 0, 1\n");
  writeImage("rgb/000000.png", cv::Mat(kColorCols, kColorRows, CV_8UC3, cv::Scalar::all(9)));
  EXPECT_THAT(refusalOfOpen(), HasSubstr("neither turned nor cropped"));
  std::filesystem::remove_all(folder_ / "depth");
  EXPECT_THAT(refusalOfOpen(), HasSubstr("no depth/000000.png"));
  std::filesystem::remove_all(folder_ / "rgb");
  folder_.write("rgb.mp4", "#EXTM3U\nhttp://example.com/a.mp4\n");
#ifdef SPHC_TEST_LIBAVFORMAT
  EXPECT_THAT(refusalOfOpen(), HasSubstr("rgb.mp4: is no MP4 file"));
#else
  EXPECT_THAT(refusalOfOpen(), HasSubstr("install libavformat-dev"));
#endif
}

#ifdef SPHC_TEST_LIBAVFORMAT
TEST_F(StrayScanner, FramesOfAVideo) {
  std::filesystem::remove_all(folder_ / "rgb");
  test::writeMp4(
      folder_ / "rgb.mp4", {"mpeg4", kColorCols, kColorRows, kFrames - 1},
      [](int image, int plane, int, int) { return static_cast<uint8_t>(plane > 0 ? 128 : 60 + 20 * image); });
  RecordingReader reader(folder_.path());
  ASSERT_EQ(reader.frameCount(), kFrames - 1) << "the video is one shorter than the odometry";
  EXPECT_EQ(reader.recording().lost_count, 1u);
  EXPECT_EQ(reader.calibration().color_camera.width, static_cast<uint32_t>(kColorCols));
  for (const uint32_t i : {0u, 1u, 4u, 2u, 2u, 3u}) {
    const double green = static_cast<const uint8_t *>(reader.read(i).color.data)[1];
    EXPECT_NEAR(green, (60 + 20 * i - 16) * 255 / 219., 5) << "frame " << i;
  }
}
#endif

}  // namespace
}  // namespace sphc::contract
