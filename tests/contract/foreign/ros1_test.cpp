#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "host/recording/recording_reader.h"
#include "tests/support/refusal.h"
#include "tests/support/ros1_bag.h"
#include "tests/support/temp_folder.h"

namespace sphc::contract {
namespace {

using recording::RecordingReader;
using test::Bytes;
using test::refusal;
using test::Ros1Bag;
using test::Ros1Writer;
using ::testing::HasSubstr;

constexpr const char *kRos1Image = "sensor_msgs/Image", *kRos1Info = "sensor_msgs/CameraInfo",
                     *kRos1Rigid = "geometry_msgs/Transform";
constexpr uint32_t kRos1Side = 16, kRos1Frames = 3;
constexpr int64_t kRos1StartNs = 1700000000100000000, kRos1StepNs = 33000000;
const sphc_rigid kRos1Same = {{1, 0, 0, 0}, {0, 0, 0}};

Bytes ros1Depth(uint16_t units) {
  Bytes pixels;
  for (uint32_t i = 0; i < kRos1Side * kRos1Side; ++i) recording::putLittle(pixels, units);
  return pixels;
}

// What both kinds of bags have: a file that is opened.
class Ros1 : public ::testing::Test {
 protected:
  void addImages(const std::string &color, const std::string &color_frame, const std::string &depth,
                 const std::string &depth_frame, const char *depth_encoding) {
    for (uint32_t i = 0; i < kRos1Frames; ++i) {
      const int64_t time_ns = kRos1StartNs + i * kRos1StepNs;
      bag_.add(color, kRos1Image, i,
               test::rosImage<Ros1Writer>(time_ns, color_frame, kRos1Side, kRos1Side, "rgb8",
                                          Bytes(kRos1Side * kRos1Side * 3, static_cast<uint8_t>(10 * i))));
      bag_.add(depth, kRos1Image, i,
               test::rosImage<Ros1Writer>(time_ns + 4000000, depth_frame, kRos1Side, kRos1Side, depth_encoding,
                                          ros1Depth(static_cast<uint16_t>(4000 + i))));
    }
  }
  void addInfo(const std::string &topic, const std::string &frame, const char *model, double focal,
               const std::vector<double> &d) {
    bag_.add(topic, kRos1Info, 0,
             test::rosCameraInfo<Ros1Writer>(frame, kRos1Side, kRos1Side, model, d, {focal, focal, 7.5, 7.5}));
  }
  std::string write(Ros1Bag::Chunks chunks = Ros1Bag::Chunks::kStored) {
    folder_.write("walk.bag", bag_.bytes(chunks));
    return folder_ / "walk.bag";
  }
  std::string refusalOfOpen(Ros1Bag::Chunks chunks = Ros1Bag::Chunks::kStored) {
    const std::string path = write(chunks);
    return refusal([&] { RecordingReader reader(path); });
  }

  Ros1Bag bag_;
  test::TempFolder folder_;
};

void expectRos1Pixels(RecordingReader &reader) {
  ASSERT_EQ(reader.frameCount(), kRos1Frames);
  for (uint32_t i = 0; i < kRos1Frames; ++i) {
    const sphc_localizer_frame frame = reader.read(i);
    EXPECT_EQ(frame.color_time_ns, kRos1StartNs + i * kRos1StepNs) << "the header's time";
    EXPECT_EQ(frame.depth_time_ns, frame.color_time_ns + 4000000);
    EXPECT_EQ(static_cast<const uint8_t *>(frame.color.data)[kRos1Side * kRos1Side * 3 - 1], 10 * i);
    EXPECT_EQ(static_cast<const uint16_t *>(frame.depth.data)[kRos1Side * kRos1Side - 1], 4000 + i);
  }
}

// A recording as librealsense makes it: no frames in the headers, streams by topic.
class RealSense : public Ros1 {
 protected:
  RealSense() {
    addImages(kColor + "/image/data", "1", kDepth + "/image/data", "1", "mono16");
    addInfo(kColor + "/info/camera_info", "", "Inverse Brown Conrady", 20, {0.1, -0.05, 0.001, 0, 0.02});
    addInfo(kDepth + "/info/camera_info", "", "None", 10, {0, 0, 0, 0, 0});
    addTransform(kColor + "/tf/0", 0.015);
    addTransform(kDepth + "/tf/0", 0.002);
    // Infrared images of 16 bits, which lie where depth does.
    bag_.add("/device_0/sensor_0/Infrared_1/image/data", kRos1Image, 0,
             test::rosImage<Ros1Writer>(kRos1StartNs, "1", kRos1Side, kRos1Side, "16UC1", ros1Depth(9)));
  }
  // stream_from_reference.
  void addTransform(const std::string &topic, double x_m) {
    Bytes message;
    Ros1Writer writer(message);
    test::putRosPose(writer, {{1, 0, 0, 0}, {x_m, 0, 0}});
    bag_.add(topic, kRos1Rigid, 0, message);
  }
  void addDepthUnit(float unit_m, const char *sensor = "/device_0/sensor_0") {
    Bytes message;
    Ros1Writer(message).put(unit_m);
    bag_.add(std::string(sensor) + "/option/Depth_Units/value", "std_msgs/Float32", 0, message);
  }

  const std::string kColor = "/device_0/sensor_1/Color_0", kDepth = "/device_0/sensor_0/Depth_0";
};

TEST_F(RealSense, ImagesInChunksAndWithout) {
  for (const Ros1Bag::Chunks chunks : {Ros1Bag::Chunks::kNone, Ros1Bag::Chunks::kStored}) {
    RecordingReader reader(write(chunks));
    expectRos1Pixels(reader);
    EXPECT_FALSE(reader.recording().is_cut);
    EXPECT_FALSE(reader.worldFromCamera(0)) << "it knows no poses";
  }
}

TEST_F(RealSense, ChunksOfLz4) {
#ifdef SPHC_TEST_LZ4
  RecordingReader reader(write(Ros1Bag::Chunks::kLz4));
  expectRos1Pixels(reader);
  std::string bytes = bag_.bytes(Ros1Bag::Chunks::kLz4);
  bytes.replace(bytes.find("compression=lz4") + 60, 40, 40, '\xFF');
  folder_.write("walk.bag", bytes);
  EXPECT_THAT(refusal([&] { RecordingReader again(folder_ / "walk.bag"); }), HasSubstr("holds no colour image"));
#else
  EXPECT_THAT(refusalOfOpen(Ros1Bag::Chunks::kLz4), HasSubstr("install liblz4-dev and build again, or"));
#endif
}

TEST_F(RealSense, CamerasAndTheTransformBetweenThem) {
  const RecordingReader reader(write());
  const sphc_rig &rig = reader.calibration();
  EXPECT_EQ(rig.color_camera.model, SPHC_CAMERA_BROWN5);
  EXPECT_EQ(rig.color_camera.params[0], 20);
  EXPECT_EQ(rig.color_camera.params[2], 8) << "its pixel centres are at 0";
  EXPECT_EQ(rig.color_camera.params[8], 0.02);
  EXPECT_EQ(rig.depth_camera.model, SPHC_CAMERA_PINHOLE);
  EXPECT_EQ(rig.depth_camera.params[0], 10);
  EXPECT_NEAR(rig.color_from_depth.t_m[0], 0.013, 1e-12) << "color_from_reference after reference_from_depth";
  EXPECT_EQ(rig.depth_unit_m, 0.001);
}

TEST_F(RealSense, TheDepthUnitIsTold) {
  addDepthUnit(0.5f, "/device_0/sensor_1");
  addDepthUnit(0.00025f);
  addDepthUnit(0.5f);
  EXPECT_NEAR(RecordingReader(write()).calibration().depth_unit_m, 0.00025, 1e-9) << "the depth sensor's first";
}

TEST_F(RealSense, AUnitThatIsNoneIsRefused) {
  addDepthUnit(0);
  EXPECT_THAT(refusalOfOpen(), HasSubstr("depth_unit_m"));
}

TEST_F(RealSense, ACameraThatIsNotToldIsNamed) {
  Ros1Bag empty;
  std::swap(bag_, empty);
  addImages(kColor + "/image/data", "1", kDepth + "/image/data", "1", "mono16");
  EXPECT_THAT(refusalOfOpen(), HasSubstr("no " + kColor + "/info/camera_info; record it too, or give"));
  addInfo(kColor + "/info/camera_info", "", "None", 20, {0, 0, 0, 0, 0});
  addInfo(kDepth + "/info/camera_info", "", "Ftheta", 20, {1, 0, 0, 0, 0});
  EXPECT_THAT(refusalOfOpen(), HasSubstr("its distortion is of the model 'Ftheta' with 5 numbers"));
}

TEST_F(RealSense, StreamsThatNothingJoinsAreNamed) {
  Ros1Bag empty;
  std::swap(bag_, empty);
  addImages(kColor + "/image/data", "1", kDepth + "/image/data", "1", "mono16");
  addInfo(kColor + "/info/camera_info", "", "None", 20, {0, 0, 0, 0, 0});
  addInfo(kDepth + "/info/camera_info", "", "None", 20, {0, 0, 0, 0, 0});
  addTransform(kColor + "/tf/0", 0.015);
  addTransform(kDepth + "/tf/1", 0.002);
  EXPECT_THAT(refusalOfOpen(), HasSubstr("no transform from " + kDepth + " to " + kColor));
}

TEST_F(RealSense, OneThatWasNotClosedGivesWhatIsWhole) {
  const std::string whole = bag_.bytes(Ros1Bag::Chunks::kNone, false);
  folder_.write("walk.bag", whole);
  EXPECT_TRUE(RecordingReader(folder_ / "walk.bag").recording().is_cut) << "it has no index";
  folder_.write("walk.bag", bag_.bytes(Ros1Bag::Chunks::kNone).substr(0, whole.size() - 100));
  const RecordingReader reader(folder_ / "walk.bag");
  EXPECT_TRUE(reader.recording().is_cut) << "its last message ends early";
  EXPECT_EQ(reader.frameCount(), kRos1Frames);
}

TEST_F(RealSense, WhatIsNotReadIsNamed) {
  EXPECT_THAT(refusalOfOpen(Ros1Bag::Chunks::kBz2), HasSubstr("by bz2, which this build does not read; write it "));
  bag_.add("/device_0/sensor_2/Color_1/image/data", kRos1Image, 0,
           test::rosImage<Ros1Writer>(kRos1StartNs, "1", kRos1Side, kRos1Side, "rgb8",
                                      Bytes(kRos1Side * kRos1Side * 3)));
  EXPECT_THAT(refusalOfOpen(), HasSubstr("Color_1/image/data may be the colour"));
}

// The accelerometer's axes are those of its stream; the gyroscope's messages have none.
TEST_F(RealSense, AccelerationsInTheColourCamerasAxes) {
  const std::string accelerometer = "/device_0/sensor_2/Accel_0", gyroscope = "/device_0/sensor_2/Gyro_0";
  Bytes transform;
  Ros1Writer writer(transform);
  test::putRosPose(writer, {{std::sqrt(0.5), 0, 0, std::sqrt(0.5)}, {0.1, 0, 0}});  // a quarter turn about z
  bag_.add(accelerometer + "/tf/0", kRos1Rigid, 0, transform);
  bag_.add(gyroscope + "/tf/0", kRos1Rigid, 0, transform);
  for (uint32_t i = 0; i < 3; ++i) {
    bag_.add(accelerometer + "/imu/data", "sensor_msgs/Imu", 0,
             test::rosImu<Ros1Writer>(kRos1StartNs + 5 * i, "0", {9.5, 1, 2}));
    bag_.add(gyroscope + "/imu/data", "sensor_msgs/Imu", 0, test::rosImu<Ros1Writer>(1, "0", {0, 0, 0}));
  }
  RecordingReader reader(write());
  const std::vector<recording::TimedAcceleration> &felt = reader.recording().accelerations;
  ASSERT_EQ(felt.size(), 3u);
  EXPECT_EQ(felt[2].time_ns, kRos1StartNs + 10);
  EXPECT_NEAR(felt[0].felt_mps2[0], 1, 1e-12);
  EXPECT_NEAR(felt[0].felt_mps2[1], -9.5, 1e-12) << "upwards";
  EXPECT_NEAR(felt[0].felt_mps2[2], 2, 1e-12);
}

// By `rosbag record`: frames in the headers, transforms, odometry.
TEST_F(Ros1, BagsOfOtherRobotsHavePoses) {
  addImages("/rgb/image_raw", "rgb", "/depth/image_raw", "/depth", "16UC1");
  addInfo("/rgb/camera_info", "rgb", "plumb_bob", 20, {0, 0, 0, 0, 0});
  addInfo("/depth/camera_info", "depth", "plumb_bob", 10, {0, 0, 0, 0, 0});
  bag_.add("/tf_static", "tf2_msgs/TFMessage", 0,
           test::rosTransforms<Ros1Writer>(
               0, {{"base", "rgb", kRos1Same}, {"base", "depth", {{1, 0, 0, 0}, {0.25, 0, 0}}}}));
  for (uint32_t i = 0; i < kRos1Frames; ++i) {
    const int64_t time_ns = kRos1StartNs + i * kRos1StepNs;
    bag_.add("/odom", "nav_msgs/Odometry", 0,
             test::rosOdometry<Ros1Writer>(time_ns, {"odom", "base", {{1, 0, 0, 0}, {1.0 + i, 0, 0}}}));
    bag_.add("/tf", "tf/tfMessage", 0,
             test::rosTransforms<Ros1Writer>(time_ns, {{"map", "odom", {{1, 0, 0, 0}, {0, 2, 0}}}}));
  }
  RecordingReader reader(write());
  expectRos1Pixels(reader);
  EXPECT_EQ(reader.calibration().color_from_depth.t_m[0], 0.25);
  for (uint32_t i = 0; i < kRos1Frames; ++i) {
    ASSERT_TRUE(reader.worldFromCamera(i));
    EXPECT_EQ(reader.worldFromCamera(i)->t_m[0], 1 + i);
    EXPECT_EQ(reader.worldFromCamera(i)->t_m[1], 2);
  }
}

}  // namespace
}  // namespace sphc::contract
