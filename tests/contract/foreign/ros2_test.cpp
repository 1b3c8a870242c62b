#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/imgcodecs.hpp>

#include "host/recording/recording_reader.h"
#include "tests/support/refusal.h"
#include "tests/support/ros_bag.h"
#include "tests/support/temp_folder.h"

namespace sphc::contract {
namespace {

using recording::RecordingReader;
using test::Bytes;
using test::NamedTransform;
using test::refusal;
using test::RosBag;
using ::testing::HasSubstr;

constexpr const char *kImage = "sensor_msgs/msg/Image", *kCompressed = "sensor_msgs/msg/CompressedImage",
                     *kInfo = "sensor_msgs/msg/CameraInfo", *kTf = "tf2_msgs/msg/TFMessage",
                     *kOdometry = "nav_msgs/msg/Odometry";
constexpr uint32_t kWidth = 32, kHeight = 24, kDepthSide = 16;
constexpr int64_t kStartNs = 1700000000000000000, kStepNs = 33000000;
constexpr const char *kColorFrame = "color_optical", *kDepthFrame = "depth_optical";
constexpr const char *kCalibration = R"({"format": "spherecloud-calibration", "version": 1, "pixel_center": 0.5,
  "color_camera": {"model": "pinhole", "width": 32, "height": 24, "params": [30, 30, 16, 12]},
  "depth_camera": {"model": "pinhole", "width": 16, "height": 16, "params": [20, 20, 8, 8]},
  "color_from_depth": {"q_wxyz": [1, 0, 0, 0], "t_m": [0, 0, 0]}, "depth_unit_m": 0.001})";
const sphc_rigid kSame = {{1, 0, 0, 0}, {0, 0, 0}};
// Of the optical frame in a body with x forward, y left, z up: right is -y, down is -z, forward is x.
const sphc_rigid kBodyFromOptical = {{0.5, -0.5, 0.5, -0.5}, {0.1, 0, 0}};

Bytes colorPixels(uint8_t level) { return Bytes(kWidth * kHeight * 3, level); }

Bytes depthPixels(uint16_t mm) {
  Bytes pixels;
  for (uint32_t i = 0; i < kDepthSide * kDepthSide; ++i) recording::putLittle(pixels, mm);
  return pixels;
}

Bytes floatDepth(float first, float rest) {
  Bytes pixels;
  for (uint32_t i = 0; i < kDepthSide * kDepthSide; ++i) {
    uint32_t bits;
    const float depth = i == 0 ? first : rest;
    std::memcpy(&bits, &depth, sizeof bits);
    recording::putLittle(pixels, bits);
  }
  return pixels;
}

Bytes encoded(const cv::Mat &image, const char *ending) {
  Bytes bytes;
  cv::imencode(ending, image, bytes);
  return bytes;
}

class Ros2 : public ::testing::Test {
 protected:
  void addColor(uint32_t i, const char *topic = "/camera/color/image_raw", const char *encoding = "rgb8") {
    bag_.add(topic, kImage, kStartNs + i * kStepNs + 5000000,
             test::rosImage(kStartNs + i * kStepNs, kColorFrame, kWidth, kHeight, encoding,
                            colorPixels(static_cast<uint8_t>(10 * i))));
  }
  void addDepth(uint32_t i, const char *topic = "/camera/depth/image_rect_raw") {
    bag_.add(topic, kImage, kStartNs + i * kStepNs + 9000000,
             test::rosImage(kStartNs + i * kStepNs + 2000000, kDepthFrame, kDepthSide, kDepthSide, "16UC1",
                            depthPixels(static_cast<uint16_t>(1000 + i))));
  }
  void addColorInfo(const std::vector<double> &d = {0.1, -0.05, 0.001, 0, 0.02}, const char *model = "plumb_bob",
                    uint32_t binning = 0, uint32_t roi_x = 0) {
    bag_.add("/camera/color/camera_info", kInfo, kStartNs,
             test::rosCameraInfo(kColorFrame, kWidth, kHeight, model, d, {30, 31, 15.5, 11.5}, binning, roi_x));
  }
  void addDepthInfo() {
    bag_.add(
        "/camera/depth/camera_info", kInfo, kStartNs,
        test::rosCameraInfo(kDepthFrame, kDepthSide, kDepthSide, "plumb_bob", {0, 0, 0, 0, 0}, {10, 11, 7.5, 7.5}));
  }
  // The depth camera is 5 cm to the left of the colour camera.
  void addBody() {
    sphc_rigid body_from_depth = kBodyFromOptical;
    body_from_depth.t_m[1] = 0.05;
    bag_.add("/tf_static", kTf, kStartNs,
             test::rosTransforms(0, {{"base_link", "camera_link", kSame},
                                     {"camera_link", kColorFrame, kBodyFromOptical},
                                     {"/camera_link", kDepthFrame, body_from_depth}}));
  }
  // Forward by a step every 11 ms; between the times of images.
  void addOdometry(const char *topic = "/odom", bool is_tf = false, const char *parent = "odom",
                   const char *child = "base_link", double step_m = 0.1) {
    for (int64_t j = -1; j < 9; ++j) {
      const int64_t time_ns = kStartNs + j * 11000000 + 5500000;
      const NamedTransform pose = {parent, child, {{1, 0, 0, 0}, {step_m * static_cast<double>(j), 0, 0}}};
      bag_.add(topic, is_tf ? kTf : kOdometry, static_cast<uint64_t>(time_ns),
               is_tf ? test::rosTransforms(time_ns, {pose}) : test::rosOdometry(time_ns, pose));
    }
  }
  void addImagesAndCameras() {
    for (uint32_t i = 0; i < 3; ++i) {
      addColor(i);
      addDepth(i);
    }
    addColorInfo();
    addDepthInfo();
  }

  std::string write(RosBag::Chunks chunks = RosBag::Chunks::kStored) {
    folder_.write("bag.mcap", bag_.bytes(chunks));
    return folder_ / "bag.mcap";
  }
  std::string refusalOfOpen() {
    const std::string path = write();
    return refusal([&] { RecordingReader reader(path); });
  }

  RosBag bag_;
  test::TempFolder folder_;
};

void expectSamePixels(RecordingReader &reader) {
  ASSERT_EQ(reader.frameCount(), 3u);
  for (uint32_t i = 0; i < 3; ++i) {
    const sphc_localizer_frame frame = reader.read(i);
    EXPECT_EQ(frame.color_time_ns, kStartNs + i * kStepNs) << "the header's time";
    EXPECT_EQ(frame.depth_time_ns, frame.color_time_ns + 2000000);
    EXPECT_EQ(frame.sequence, i);
    EXPECT_EQ(static_cast<const uint8_t *>(frame.color.data)[kWidth * kHeight * 3 - 1], 10 * i);
    EXPECT_EQ(static_cast<const uint16_t *>(frame.depth.data)[kDepthSide * kDepthSide - 1], 1000 + i);
  }
}

TEST_F(Ros2, ImagesInChunksAndWithout) {
  addImagesAndCameras();
  addBody();
  for (const RosBag::Chunks chunks : {RosBag::Chunks::kNone, RosBag::Chunks::kStored, RosBag::Chunks::kZstd}) {
    RecordingReader reader(write(chunks));
    expectSamePixels(reader);
    EXPECT_FALSE(reader.recording().is_cut);
    EXPECT_FALSE(reader.worldFromCamera(0));
  }
}

TEST_F(Ros2, CamerasAndTheTransformBetweenThem) {
  addImagesAndCameras();
  addBody();
  const RecordingReader reader(write());
  const sphc_camera &color = reader.calibration().color_camera, &depth = reader.calibration().depth_camera;
  EXPECT_EQ(color.model, SPHC_CAMERA_BROWN5);
  EXPECT_EQ(color.params[0], 30);
  EXPECT_EQ(color.params[2], 16) << "ROS's pixel centres are at 0";
  EXPECT_EQ(color.params[8], 0.02);
  EXPECT_EQ(depth.model, SPHC_CAMERA_PINHOLE) << "of a rectified topic, whose projection counts";
  EXPECT_EQ(depth.params[0], 20);
  const sphc_rigid &color_from_depth = reader.calibration().color_from_depth;
  EXPECT_NEAR(std::abs(color_from_depth.q_wxyz[0]), 1, 1e-12);
  EXPECT_NEAR(color_from_depth.t_m[0], -0.05, 1e-12) << "left is -x of a camera";
  EXPECT_NEAR(color_from_depth.t_m[2], 0, 1e-12);
}

TEST_F(Ros2, ATopicWithRectWithinAWordIsNotRectified) {
  for (uint32_t i = 0; i < 3; ++i) {
    addColor(i, "/direct/color/image_raw");
    addDepth(i);
  }
  bag_.add("/direct/color/camera_info", kInfo, kStartNs,
           test::rosCameraInfo(kColorFrame, kWidth, kHeight, "plumb_bob", {0.1, 0, 0, 0, 0}, {30, 31, 15.5, 11.5}));
  addDepthInfo();
  addBody();
  const RecordingReader reader(write());
  EXPECT_EQ(reader.calibration().color_camera.model, SPHC_CAMERA_BROWN5);
  EXPECT_EQ(reader.calibration().color_camera.params[0], 30);
}

void expectWalksForward(const RecordingReader &reader) {
  for (uint32_t i = 0; i < 3; ++i) {
    const std::optional<sphc_rigid> pose = reader.worldFromCamera(i);
    ASSERT_TRUE(pose);
    EXPECT_NEAR(pose->t_m[0], 0.1 * (3 * i - 0.5) + 0.1, 1e-9);
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(pose->q_wxyz[k], kBodyFromOptical.q_wxyz[k], 1e-12);
  }
}

TEST_F(Ros2, PosesAreTheBodysThroughToTheCamera) {
  addImagesAndCameras();
  addBody();
  addOdometry();
  expectWalksForward(RecordingReader(write()));
}

TEST_F(Ros2, TopicsNamedLikeOursAreReadAsTheRobots) {
  for (uint32_t i = 0; i < 3; ++i) {
    addColor(i, "/color/image");
    addDepth(i, "/depth/image");
  }
  bag_.add("/color/camera_info", kInfo, kStartNs,
           test::rosCameraInfo(kColorFrame, kWidth, kHeight, "plumb_bob", {}, {30, 31, 15.5, 11.5}));
  bag_.add("/depth/camera_info", kInfo, kStartNs,
           test::rosCameraInfo(kDepthFrame, kDepthSide, kDepthSide, "plumb_bob", {}, {10, 11, 7.5, 7.5}));
  addBody();
  addOdometry();
  RecordingReader reader(write());
  EXPECT_EQ(reader.recording().layout, recording::Layout::kRos2);
  expectSamePixels(reader);
  expectWalksForward(reader);
}

TEST_F(Ros2, PosesOfTransforms) {
  addImagesAndCameras();
  addBody();
  addOdometry("/tf", true);
  // A map that is told seldom, and moved against the odometry, at the time of image 1 by a metre to the left.
  for (const int64_t at : {-100000000, 100000000})
    bag_.add("/tf", kTf, kStartNs,
             test::rosTransforms(kStartNs + kStepNs + at,
                                 {{"map", "odom", {{1, 0, 0, 0}, {0, 1 + static_cast<double>(at) / 1e9, 0}}}}));
  const RecordingReader reader(write());
  expectWalksForward(reader);
  EXPECT_NEAR(reader.worldFromCamera(1)->t_m[1], 1, 1e-9);
}

// Wheels and a filter tell of one body, and their steps differ.
TEST_F(Ros2, TwoTopicsOfOdometryOfOneBodyTellNothing) {
  addImagesAndCameras();
  addBody();
  addOdometry("/odometry/filtered");
  addOdometry("/arm/odom", false, "odom", "arm");
  EXPECT_TRUE(RecordingReader(write()).worldFromCamera(0)) << "of another body, which is no rival";
  addOdometry("/wheel/odom", false, "odom", "base_link", 0.11);
  const RecordingReader rivals(write());
  EXPECT_FALSE(rivals.worldFromCamera(0));
  EXPECT_EQ(rivals.recording().pose_fault,
            "it has no poses: both /odometry/filtered and /wheel/odom may tell where base_link was; leave one out "
            "(docs/imports.md says how), or take spherecloud map");
}

TEST_F(Ros2, NorDoTwoInDifferentWorlds) {
  addImagesAndCameras();
  addBody();
  addOdometry("/odom");
  addOdometry("/truth", false, "world");
  EXPECT_THAT(RecordingReader(write()).recording().pose_fault,
              HasSubstr("both /odom and /truth may tell where base_link was"));
}

TEST_F(Ros2, TransformsComeBeforeOdometry) {
  addImagesAndCameras();
  addBody();
  addOdometry("/wheel/odom", false, "odom", "base_link", 0.11);
  addOdometry("/other/odom", false, "world", "base_link", 0.12);
  addOdometry("/tf", true);
  expectWalksForward(RecordingReader(write()));
}

// As a tracking camera tells that is screwed to the robot: its frame has a parent already.
class OdometryOfAPart : public Ros2 {
 protected:
  // A quarter turn to the left, 20 cm in front of the body's frame.
  void addTracker() {
    const double half = std::sqrt(0.5);
    bag_.add("/tf_static", kTf, kStartNs,
             test::rosTransforms(0, {{"camera_link", "tracker", {{half, 0, 0, half}, {0.2, 0, 0}}}}));
  }
  // base_link itself would be told to be at 0.1 j, turned back by a quarter.
  void addTrackerOdometry() {
    for (int64_t j = -1; j < 9; ++j) {
      const int64_t time_ns = kStartNs + j * 11000000 + 5500000;
      bag_.add(
          "/tracker/odom", kOdometry, kStartNs,
          test::rosOdometry(time_ns, {"world", "tracker", {{1, 0, 0, 0}, {0.1 * static_cast<double>(j), 0, 0}}}));
    }
  }
  void expectPoses() {
    const RecordingReader reader(write());
    for (uint32_t i = 0; i < 3; ++i) {
      ASSERT_TRUE(reader.worldFromCamera(i));
      // The camera is 10 cm behind the tracker, which looks along y of the body.
      EXPECT_NEAR(reader.worldFromCamera(i)->t_m[0], 0.1 * (3 * i - 0.5), 1e-9);
      EXPECT_NEAR(reader.worldFromCamera(i)->t_m[1], 0.1, 1e-9);
    }
  }
};

TEST_F(OdometryOfAPart, MovesTheWholeBody) {
  addImagesAndCameras();
  addBody();
  addTracker();
  addTrackerOdometry();
  expectPoses();
}

TEST_F(OdometryOfAPart, InWhateverOrderItIsTold) {
  addTrackerOdometry();
  addImagesAndCameras();
  addTracker();
  addBody();
  expectPoses();
}

TEST_F(OdometryOfAPart, IsARivalOfTheWheels) {
  addImagesAndCameras();
  addBody();
  addTracker();
  addTrackerOdometry();
  addOdometry();
  EXPECT_THAT(RecordingReader(write()).recording().pose_fault,
              HasSubstr("both /tracker/odom and /odom may tell where base_link was"));
}

// Of transforms those count that make a tree.
TEST_F(OdometryOfAPart, TransformsOfTheBodyComeBeforeThoseOfAPart) {
  addImagesAndCameras();
  addBody();
  addOdometry("/tf", true, "world", "camera_link", 0.2);
  addOdometry("/tf", true);
  expectWalksForward(RecordingReader(write()));
}

TEST_F(Ros2, OdometryThatMovesNothingIsNamed) {
  for (const auto &[parent, child] : {std::pair("odom", ""), {"", "base_link"}, {"base_link", kColorFrame}}) {
    bag_ = {};
    addImagesAndCameras();
    addBody();
    addOdometry("/odom", false, parent, child);
    EXPECT_EQ(
        RecordingReader(write()).recording().pose_fault,
        std::string("it has no poses: /odom tells where \"") + child + "\" was in \"" + parent +
            "\", and one has no name, or both are of one body; record it with two names in child_frame_id and "
            "header.frame_id, or take spherecloud map");
  }
}

// As those who have no /tf_static tell what is fixed; a quaternion and its negative are one rotation.
TEST_F(Ros2, TransformsThatNeverChangeAreFixed) {
  addImagesAndCameras();
  const auto add_mount = [this](int64_t i, double y_m) {
    const double sign = i % 2 == 0 ? 1 : -1;
    bag_.add(
        "/tf", kTf, kStartNs,
        test::rosTransforms(kStartNs + i * 50000000, {{"base_link", kColorFrame, {{sign, 0, 0, 0}, {0, 0, 0}}},
                                                      {"base_link", kDepthFrame, {{sign, 0, 0, 0}, {0, y_m, 0}}}}));
  };
  for (int64_t i = -1; i < 4; ++i) add_mount(i, 0.25);
  EXPECT_TRUE(RecordingReader(write()).recording().poses.poses().empty()) << "nothing moves";
  addOdometry("/tf", true);
  const RecordingReader reader(write());
  EXPECT_EQ(reader.calibration().color_from_depth.t_m[1], 0.25);
  ASSERT_TRUE(reader.worldFromCamera(2));
  EXPECT_NEAR(reader.worldFromCamera(2)->t_m[0], 0.55, 1e-9);
  add_mount(4, 0.2501);
  EXPECT_THAT(refusalOfOpen(),
              HasSubstr("bag.mcap: depth_optical and color_optical are joined only by what moves on "
                        "/tf; give a calibration file"));
}

TEST_F(Ros2, ABodyThatOdometryTellsOfMovesEvenWhereItStandsStill) {
  addImagesAndCameras();
  addBody();
  addOdometry("/tf", true, "odom", "base_link", 0);
  addOdometry("/odom", false, "odom", "base_link", 0);
  EXPECT_TRUE(RecordingReader(write()).worldFromCamera(0));
}

// Of nodes that somebody made himself.
TEST_F(Ros2, TwoImagesWithoutAFrameAreNotInOneFrame) {
  bag_.add("/camera/color/image_raw", kImage, kStartNs,
           test::rosImage(kStartNs, "", kWidth, kHeight, "rgb8", colorPixels(9)));
  bag_.add("/camera/depth/image_raw", kImage, kStartNs,
           test::rosImage(kStartNs, "", kDepthSide, kDepthSide, "16UC1", depthPixels(1000)));
  addColorInfo();
  addDepthInfo();
  addOdometry();
  EXPECT_THAT(
      refusalOfOpen(),
      HasSubstr("bag.mcap: the images of /camera/color/image_raw name no frame (header.frame_id), so nothing "
                "tells where depth lies on colour; record them with one, or give a calibration file"));
  folder_.write("c.json", kCalibration);
  recording::ReaderOptions options;
  options.calibration = folder_ / "c.json";
  EXPECT_THAT(
      RecordingReader(write(), options).recording().pose_fault,
      HasSubstr("moves base_link, and the colour images name no frame (header.frame_id); record them with"));
}

TEST_F(Ros2, FramesThatHangInARingHaveNoPoses) {
  addImagesAndCameras();
  bag_.add("/tf", kTf, kStartNs,
           test::rosTransforms(kStartNs, {{"a", kColorFrame, kSame}, {kColorFrame, "a", kSame}}));
  EXPECT_THAT(refusalOfOpen(), HasSubstr("no transform from depth_optical to color_optical in tf_static"));
}

// Without tf_static nothing says where on the body the camera is.
TEST_F(Ros2, OdometryThatNothingJoinsToTheCameraIsNamed) {
  addImagesAndCameras();
  addOdometry();
  bag_.add("/tf_static", kTf, kStartNs, test::rosTransforms(0, {{kColorFrame, kDepthFrame, kSame}}));
  bag_.add("/tf", kTf, kStartNs, test::rosTransforms(kStartNs, {{"arm", "finger", kSame}}));
  EXPECT_EQ(RecordingReader(write()).recording().pose_fault,
            "it has no poses: odometry or tf moves base_link, and no transform joins that to color_optical, the "
            "colour camera's frame; record /tf_static with it, or take spherecloud map");
}

TEST_F(Ros2, WhatMovesOnTheCameraSaysNothingOfPoses) {
  addImagesAndCameras();
  addBody();
  bag_.add("/tf", kTf, kStartNs, test::rosTransforms(kStartNs, {{"camera_link", "shutter", kSame}}));
  EXPECT_EQ(RecordingReader(write()).recording().pose_fault, "");
}

TEST_F(Ros2, ImagesOfATimeThatWasAreCounted) {
  addImagesAndCameras();
  addBody();
  for (const uint32_t again : {1u, 2u}) addColor(again);
  const RecordingReader reader(write());
  EXPECT_EQ(reader.frameCount(), 3u);
  EXPECT_EQ(reader.recording().backward_count, 2u);
  EXPECT_EQ(reader.recording().lost_count, 2u);
}

TEST_F(Ros2, DepthOf8BitsIsNoColour) {
  const auto add_picture = [this](const char *topic, const char *encoding, uint32_t channels) {
    bag_.add(
        topic, kImage, kStartNs,
        test::rosImage(kStartNs, kColorFrame, kWidth, kHeight, encoding, Bytes(kWidth * kHeight * channels, 3)));
  };
  add_picture("/camera/depth/image_color", "rgb8", 3);
  add_picture("/camera/aligned_depth/image", "8UC1", 1);
  EXPECT_THAT(refusalOfOpen(),
              HasSubstr("no colour image that is read (topics of images: /camera/aligned_depth/image of 8UC1, "));
  add_picture("/depth_camera/image_raw", "rgb8", 3);
  EXPECT_THAT(refusalOfOpen(), HasSubstr("no depth image that is read"));
  addDepth(0);
  addDepthInfo();
  bag_.add("/depth_camera/camera_info", kInfo, kStartNs,
           test::rosCameraInfo(kColorFrame, kWidth, kHeight, "plumb_bob", {}, {30, 31, 15.5, 11.5}));
  addBody();
  EXPECT_EQ(static_cast<const uint8_t *>(RecordingReader(write()).read(0).color.data)[0], 3);
}

TEST_F(Ros2, ACameraOfAnotherSizeThanItsImagesIsNamed) {
  addColor(0);
  addDepth(0);
  addDepthInfo();
  addBody();
  bag_.add("/camera/color/camera_info", kInfo, kStartNs,
           test::rosCameraInfo(kColorFrame, 2 * kWidth, kHeight, "plumb_bob", {}, {30, 31, 15.5, 11.5}));
  EXPECT_THAT(refusalOfOpen(), HasSubstr("/camera/color/camera_info: is of images of 64 x 24, and those of "
                                         "/camera/color/image_raw are 32 x 24; record the camera_info"));
}

TEST_F(Ros2, SoIsACameraOfAnotherSizeThanItsCompressedImages) {
  addDepth(0);
  addDepthInfo();
  addBody();
  const cv::Mat color(kHeight, kWidth, CV_8UC3, cv::Scalar::all(70));
  bag_.add("/camera/color/image_raw/compressed", kCompressed, kStartNs,
           test::rosCompressedImage(kStartNs, kColorFrame, "rgb8; jpeg compressed bgr8", encoded(color, ".jpg")));
  bag_.add("/camera/color/camera_info", kInfo, kStartNs,
           test::rosCameraInfo(kColorFrame, 2 * kWidth, kHeight, "plumb_bob", {}, {30, 31, 15.5, 11.5}));
  EXPECT_THAT(refusalOfOpen(), HasSubstr("/camera/color/camera_info: is of images of 64 x 24, and those of "
                                         "/camera/color/image_raw/compressed are 32 x 24"));
}

TEST_F(Ros2, TimesThatGoBackAreTold) {
  for (const uint32_t i : {0u, 1u, 5u, 6u, 2u, 3u, 4u}) addColor(i);
  for (uint32_t i = 0; i < 7; ++i) addDepth(i);
  addColorInfo();
  addDepthInfo();
  addBody();
  RecordingReader reader(write());
  EXPECT_EQ(reader.frameCount(), 7u);
  EXPECT_THAT(
      reader.recording().order_faults,
      ::testing::ElementsAre(HasSubstr("the times of /camera/color/image_raw go back once, first at image 4 "
                                       "(from 0, as they lie in the file) by 132 ms; images were put in")));
}

TEST_F(Ros2, DepthThatLiesOnColourComesFirst) {
  addImagesAndCameras();
  addBody();
  const char *topic = "/camera/aligned_depth_to_color/image_raw";
  bag_.add(topic, kImage, kStartNs,
           test::rosImage(kStartNs, kColorFrame, kWidth, kHeight, "16UC1", Bytes(kWidth * kHeight * 2, 3)));
  bag_.add("/camera/aligned_depth_to_color/camera_info", kInfo, kStartNs,
           test::rosCameraInfo(kColorFrame, kWidth, kHeight, "plumb_bob", {}, {30, 31, 15.5, 11.5}));
  RecordingReader reader(write());
  ASSERT_EQ(reader.frameCount(), 1u);
  EXPECT_EQ(static_cast<const uint16_t *>(reader.read(0).depth.data)[0], 0x303);
  EXPECT_EQ(reader.calibration().color_from_depth.t_m[0], 0);
}

TEST_F(Ros2, FloatDepthBecomesMillimetres) {
  addColor(0);
  addColorInfo();
  addDepthInfo();
  addBody();
  for (const float first :
       {-1.0f, 0.0f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 65.6f})
    bag_.add("/camera/depth/image_raw", kImage, kStartNs,
             test::rosImage(kStartNs + static_cast<int64_t>(bag_.bytes(RosBag::Chunks::kNone).size()), kDepthFrame,
                            kDepthSide, kDepthSide, "32FC1", floatDepth(first, 1.2344f)));
  RecordingReader reader(write());
  ASSERT_EQ(reader.recording().depth.size(), 5u);
  ASSERT_EQ(reader.frameCount(), 1u);
  recording::ImageReader images(reader.recording(), reader.calibration(), SPHC_FORMAT_BGR8);
  std::vector<uint16_t> depth(kDepthSide * kDepthSide);
  for (const recording::RecordedImage &image : reader.recording().depth) {
    images.read(SPHC_STREAM_DEPTH, image, reinterpret_cast<uint8_t *>(depth.data()));
    EXPECT_EQ(depth[0], 0);
    EXPECT_EQ(depth[1], 1234);
  }
}

TEST_F(Ros2, CompressedImages) {
  addColorInfo();
  addDepthInfo();
  addBody();
  const cv::Mat color(kHeight, kWidth, CV_8UC3, cv::Scalar::all(70)), depth(kDepthSide, kDepthSide, CV_16UC1, 2345);
  Bytes png = encoded(depth, ".png");
  png.insert(png.begin(), 12, uint8_t{0});
  bag_.add("/camera/color/image_raw/compressed", kCompressed, kStartNs,
           test::rosCompressedImage(kStartNs, kColorFrame, "rgb8; jpeg compressed bgr8", encoded(color, ".jpg")));
  bag_.add("/camera/depth/image_raw/compressedDepth", kCompressed, kStartNs,
           test::rosCompressedImage(kStartNs, kDepthFrame, "16UC1; compressedDepth png", png));
  RecordingReader reader(write());
  ASSERT_EQ(reader.frameCount(), 1u);
  const sphc_localizer_frame frame = reader.read(0);
  EXPECT_NEAR(static_cast<const uint8_t *>(frame.color.data)[0], 70, 2);
  EXPECT_EQ(static_cast<const uint16_t *>(frame.depth.data)[0], 2345);
}

// As image_transport writes it where its format is png: without the head of compressedDepth.
TEST_F(Ros2, DepthAsPlainPng) {
  addColor(0, "/camera/color/image_raw");
  const cv::Mat depth(kDepthSide, kDepthSide, CV_16UC1, 2345);
  const auto add_depth = [&](const char *topic, const char *format, const char *ending = ".png") {
    bag_.add(topic, kCompressed, kStartNs,
             test::rosCompressedImage(kStartNs, kDepthFrame, format, encoded(depth, ending)));
  };
  add_depth("/aligned_to_color/image_raw/compressed", "16UC1; jpeg compressed ", ".jpg");
  add_depth("/camera/color/grey/compressed", "mono16; png compressed ");
  EXPECT_THAT(refusalOfOpen(), HasSubstr("holds no depth image that is read"));
  add_depth("/aligned_to_color/image/compressed", "16UC1; png compressed ");
  folder_.write("c.json", kCalibration);
  recording::ReaderOptions options;
  options.calibration = folder_ / "c.json";
  EXPECT_EQ(static_cast<const uint16_t *>(RecordingReader(write(), options).read(0).depth.data)[0], 2345);
  add_depth("/camera/depth/image/compressed", "mono16; png compressed ");
  EXPECT_THAT(refusalOfOpen(),
              HasSubstr("both /aligned_to_color/image/compressed and /camera/depth/image/compressed may be"));
  Bytes png = encoded(cv::Mat(kDepthSide, kDepthSide, CV_16UC1, 3456), ".png");
  png.insert(png.begin(), 12, uint8_t{0});
  bag_.add("/camera/depth/image/compressedDepth", kCompressed, kStartNs,
           test::rosCompressedImage(kStartNs, kDepthFrame, "mono16; compressedDepth png", png));
  EXPECT_EQ(static_cast<const uint16_t *>(RecordingReader(write(), options).read(0).depth.data)[0], 3456);
}

TEST_F(Ros2, ABagIsAFolderToo) {
  addImagesAndCameras();
  addBody();
  folder_.write("walk/metadata.yaml", "rosbag2_bagfile_information:\n");
  EXPECT_THAT(refusal([&] { RecordingReader reader(folder_ / "walk"); }), HasSubstr("without its .mcap"));
  folder_.write("walk/walk_0.mcap", bag_.bytes(RosBag::Chunks::kZstd));
  RecordingReader reader(folder_ / "walk");
  expectSamePixels(reader);
  folder_.write("walk/walk_1.mcap", "");
  EXPECT_THAT(refusal([&] { RecordingReader again(folder_ / "walk"); }), HasSubstr("mcap merge"));
  folder_.write("walk/walk_0.db3", "");
  std::filesystem::remove(folder_ / "walk/walk_0.mcap");
  std::filesystem::remove(folder_ / "walk/walk_1.mcap");
  EXPECT_THAT(refusal([&] { RecordingReader again(folder_ / "walk"); }), HasSubstr("ros2 bag convert"));
}

TEST_F(Ros2, ACutFileGivesWhatIsWhole) {
  addImagesAndCameras();
  addBody();
  addColor(3);
  const std::string whole = bag_.bytes(RosBag::Chunks::kNone);
  folder_.write("bag.mcap", whole.substr(0, whole.size() - 500));
  const RecordingReader reader(folder_ / "bag.mcap");
  EXPECT_EQ(reader.recording().color.size(), 3u);
  EXPECT_TRUE(reader.recording().is_cut);
}

TEST_F(Ros2, ACameraThatIsNotToldIsGivenByAFile) {
  addColor(0);
  addDepth(0);
  EXPECT_THAT(refusalOfOpen(),
              HasSubstr("no /camera/color/camera_info; record it too, or give a calibration file"));
  folder_.write("c.json", kCalibration);
  recording::ReaderOptions options;
  options.calibration = folder_ / "c.json";
  EXPECT_EQ(RecordingReader(write(), options).frameCount(), 1u);
}

TEST_F(Ros2, WhatIsNotReadIsNamed) {
  addDepth(0);
  EXPECT_THAT(refusalOfOpen(), HasSubstr("holds no colour image that is read (topics of images: /camera/depth/"));
  addColor(0);
  addColorInfo({0.1, 0, 0}, "plumb_bob");
  EXPECT_THAT(refusalOfOpen(), HasSubstr("/camera/color/camera_info: its distortion is of the model 'plumb_bob' "
                                         "with 3 numbers; plumb_bob (4 or 5)"));
  folder_.write("bag.mcap", bag_.bytes(RosBag::Chunks::kBrotli));
  EXPECT_THAT(refusal([&] { RecordingReader reader(folder_ / "bag.mcap"); }), HasSubstr("mcap compress"));
  addColor(0, "/other/color/image_raw");
  EXPECT_THAT(refusalOfOpen(),
              HasSubstr("both /camera/color/image_raw and /other/color/image_raw may be the colour"));
}

// As "mcap convert" makes one of a bag of ROS 1.
TEST_F(Ros2, MessagesOfRos1InMcap) {
  const auto add = [&](const char *topic, const char *type, const Bytes &message) {
    bag_.add(topic, type, kStartNs, message, "ros1");
  };
  using Writer = test::Ros1Writer;
  add("/tf_static", "tf2_msgs/TFMessage",
      test::rosTransforms<Writer>(0, {{"b", kColorFrame, kSame}, {"b", kDepthFrame, kSame}}));
  add("/color/camera_info", "sensor_msgs/CameraInfo",
      test::rosCameraInfo<Writer>(kColorFrame, kWidth, kHeight, "plumb_bob", {}, {30, 31, 15.5, 11.5}));
  add("/depth/camera_info", "sensor_msgs/CameraInfo",
      test::rosCameraInfo<Writer>(kDepthFrame, kDepthSide, kDepthSide, "plumb_bob", {}, {10, 11, 7.5, 7.5}));
  add("/color/image", "sensor_msgs/Image",
      test::rosImage<Writer>(kStartNs, kColorFrame, kWidth, kHeight, "rgb8", colorPixels(9)));
  add("/depth/image", "sensor_msgs/Image",
      test::rosImage<Writer>(kStartNs, kDepthFrame, kDepthSide, kDepthSide, "16UC1", depthPixels(1234)));
  RecordingReader reader(write());
  ASSERT_EQ(reader.frameCount(), 1u);
  EXPECT_EQ(static_cast<const uint16_t *>(reader.read(0).depth.data)[5], 1234);
}

TEST_F(Ros2, BinnedImagesAreRefused) {
  addColor(0);
  addDepth(0);
  addColorInfo({}, "plumb_bob", 2);
  EXPECT_THAT(refusalOfOpen(), HasSubstr("binned"));
}

TEST_F(Ros2, ImagesOfAPartOfTheSensorAreRefused) {
  addColor(0);
  addDepth(0);
  addColorInfo({}, "plumb_bob", 0, 8);
  EXPECT_THAT(refusalOfOpen(), HasSubstr("a part of the sensor's (binning, roi)"));
}

TEST_F(Ros2, AnEncodingThatIsNotReadIsNamed) {
  addColor(0);
  addColor(1, "/camera/color/image_raw", "bayer_rggb8");
  for (const uint32_t i : {0u, 1u}) addDepth(i);
  addColorInfo();
  addDepthInfo();
  addBody();
  RecordingReader reader(write());
  EXPECT_THAT(refusal([&] { reader.read(1); }), HasSubstr("is of the encoding \"bayer_rggb8\"; rgb8, bgr8"));
}

// As industrial cameras record their sensor's images beside those that a node makes of them.
TEST_F(Ros2, ATopicThatIsNotReadIsNoColour) {
  addColor(0, "/camera/color/image_raw", "bayer_rggb8");
  addDepth(0);
  addColorInfo();
  addDepthInfo();
  addBody();
  EXPECT_THAT(refusalOfOpen(),
              AllOf(HasSubstr("/camera/color/image_raw of bayer_rggb8"), HasSubstr("; rgb8, bgr8")));
  const cv::Mat color(kHeight, kWidth, CV_8UC3, cv::Scalar::all(70));
  bag_.add(
      "/camera/color/image_rect/compressed", kCompressed, kStartNs,
      test::rosCompressedImage(kStartNs, kColorFrame, "bayer_rggb8; png compressed bgr8", encoded(color, ".png")));
  EXPECT_EQ(static_cast<const uint8_t *>(RecordingReader(write()).read(0).color.data)[0], 70);
}

TEST_F(Ros2, GreyOf16BitsNamesWhatIsRead) {
  addColor(0, "/camera/image_raw", "mono16");
  addDepth(0);
  EXPECT_THAT(refusalOfOpen(),
              AllOf(HasSubstr("/camera/image_raw of mono16"), HasSubstr("; rgb8, bgr8"), HasSubstr("mono8")));
}

TEST_F(Ros2, FourChannelsOfOpencvAreBgra) {
  Bytes pixels;
  for (uint32_t i = 0; i < kWidth * kHeight; ++i) pixels.insert(pixels.end(), {1, 2, 3, 255});
  bag_.add("/camera/color/image_raw", kImage, kStartNs,
           test::rosImage(kStartNs, kColorFrame, kWidth, kHeight, "8UC4", pixels));
  addDepth(0);
  addColorInfo();
  addDepthInfo();
  addBody();
  RecordingReader reader(write());
  const auto *bgr = static_cast<const uint8_t *>(reader.read(0).color.data);
  for (uint32_t i = 0; i < 6; ++i) EXPECT_EQ(bgr[i], 1 + i % 3);
}

// Of several inertial sensors the one that says most; one that is not fixed to the camera says nothing of it.
TEST_F(Ros2, AccelerationsOfTheBodyThatHasTheCamera) {
  addImagesAndCameras();
  addBody();
  addOdometry();
  for (int64_t i = 4; i >= 0; --i) {    // in no order
    for (const double up : {9.5, 3.0})  // the second of a time is left out
      bag_.add("/imu", "sensor_msgs/msg/Imu", kStartNs, test::rosImu(kStartNs + i, "base_link", {1, 2, up}));
    if (i < 3)
      bag_.add("/imu_slow", "sensor_msgs/msg/Imu", kStartNs, test::rosImu(kStartNs + i, "base_link", {5, 5, 5}));
  }
  for (int64_t i = 0; i < 9; ++i) {
    bag_.add("/arm/imu", "sensor_msgs/msg/Imu", kStartNs, test::rosImu(kStartNs + i, "arm", {7, 7, 7}));
    bag_.add("/imu", "sensor_msgs/msg/Imu", kStartNs, test::rosImu(kStartNs + i, "base_link", {7, 7, 7}, false));
  }
  RecordingReader reader(write());
  const std::vector<recording::TimedAcceleration> &felt = reader.recording().accelerations;
  ASSERT_EQ(felt.size(), 5u);
  for (int64_t i = 0; i < 5; ++i) EXPECT_EQ(felt[i].time_ns, kStartNs + i);
  EXPECT_NEAR(felt[0].felt_mps2[0], -2, 1e-12) << "left is -x";
  EXPECT_NEAR(felt[0].felt_mps2[1], -9.5, 1e-12) << "up is -y";
  EXPECT_NEAR(felt[0].felt_mps2[2], 1, 1e-12) << "forward is z";
}

}  // namespace
}  // namespace sphc::contract
