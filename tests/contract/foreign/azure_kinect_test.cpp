#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "host/recording/recording_reader.h"
#include "tests/support/matroska.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"
#include "tests/unit/host/calibration/golden_files.h"

namespace sphc::contract {
namespace {

using recording::RecordingReader;
using test::KinectFile;
using test::KinectTrack;
using test::refusal;
using ::testing::HasSubstr;

// The smallest mode of each camera.
constexpr uint32_t kColorWidth = 1280, kColorHeight = 720, kDepthWidth = 320, kDepthHeight = 288;
constexpr size_t kColorPixels = size_t{kColorWidth} * kColorHeight,
                 kDepthPixels = size_t{kDepthWidth} * kDepthHeight;
constexpr int kColor = 1, kDepth = 2, kInertial = 4;
constexpr int64_t kKinectStartNs = 7000000000;

std::string repeated(const std::string &bytes, size_t count) {
  std::string all;
  all.reserve(bytes.size() * count);
  for (size_t i = 0; i < count; ++i) all += bytes;
  return all;
}
std::string depthImage(uint16_t depth_mm) { return repeated(test::bigEndian(depth_mm, 2), kDepthPixels); }
// A reddish grey, so that channels cannot be taken for each other.
std::string bgraImage(uint8_t value) {
  const char bgra[] = {static_cast<char>(value), static_cast<char>(value + 5), static_cast<char>(value + 90), 7};
  return repeated({bgra, 4}, kColorPixels);
}
std::string jpegImage(uint8_t value) {
  const cv::Mat image(kColorHeight, kColorWidth, CV_8UC3, cv::Scalar(value, value + 5, value + 90));
  std::vector<uint8_t> bytes;
  cv::imencode(".jpg", image, bytes);
  return {bytes.begin(), bytes.end()};
}
// Y 110, U 120, V 180: by BT.601 red 193, green 70, blue 93.
std::string nv12Image() {
  return std::string(kColorPixels, '\x6E') + repeated(std::string("\x78\xB4", 2), kColorPixels / 4);
}
std::string yuy2Image() { return repeated(std::string("\x6E\x78\x6E\xB4", 4), kColorPixels / 2); }

// Of the track IMU; little-endian, and what the gyroscope says is not read.
std::string inertialSample(uint64_t time, const std::array<float, 3> &felt_mps2) {
  recording::Bytes bytes;
  recording::putLittle(bytes, time);
  recording::append(bytes, felt_mps2.data(), sizeof felt_mps2);
  return std::string(textOf(recording::viewOf(bytes))) + std::string(20, 'g');
}
// As the kit writes a block of several samples: all of one length, or with the sizes of all but the last.
std::string lacedSamples(const std::vector<std::string> &samples, bool of_one_length = true) {
  std::string bytes(1, static_cast<char>(samples.size() - 1));
  if (!of_one_length) bytes += std::string(samples.size() - 1, '\x28');
  for (const std::string &sample : samples) bytes += sample;
  return bytes;
}
// A camera that is level, as a device's own file tells it: z of the accelerometer is down in the depth image.
constexpr const char *kAccelerometer =
    R"("InertialSensors": [{"SensorType": "CALIBRATION_InertialSensorType_Gyro"},
{"SensorType": "CALIBRATION_InertialSensorType_Accelerometer",
 "Rt": {"Rotation": [0, 0, -1, -1, 0, 0, 0, 1, 0], "Translation": [-0.05, 0.003, 0.001]}}])";

class AzureKinect : public ::testing::Test {
 protected:
  void addTracks(const std::string &fourcc) {
    file_.addTrack({"COLOR", fourcc, kColorWidth, kColorHeight});
    file_.addTrack({"DEPTH", "b16g", kDepthWidth, kDepthHeight});
    file_.addTrack({"IR", "b16g", kDepthWidth, kDepthHeight});
    file_.addTrack({"IMU", "", 0, 0, "S_K4A/IMU"});
  }
  void addEnd() {
    file_.attach("calibration.json", host::kAzureKinectFile);
    file_.tag("K4A_DEPTH_MODE", "NFOV_2X2BINNED");
    file_.tag("K4A_CALIBRATION_FILE", "calibration.json");
    file_.tag("K4A_START_OFFSET_NS", std::to_string(kKinectStartNs));
  }
  // Two frames in two clusters, depth a millisecond after colour.
  void addFrames(const std::vector<std::string> &color, bool in_group = false) {
    for (uint16_t i = 0; i < color.size(); ++i) {
      file_.beginCluster(33333u * i + 100);
      file_.addBlock(kDepth, 900, depthImage(static_cast<uint16_t>(1000 + i)), in_group);
      file_.addBlock(kColor, -100, color[i], in_group);
      file_.addBlock(3, 900, depthImage(static_cast<uint16_t>(70 + i)));
      file_.addBlock(kInertial, 1, inertialSample(7000101 + 33333u * i, {1, 2, 3}));
    }
  }
  std::string write(const std::string &bytes) {
    folder_.write("walk.mkv", bytes);
    return folder_ / "walk.mkv";
  }
  std::string write() { return write(file_.bytes()); }
  // A whole recording.
  void addRecording(const std::string &fourcc, const std::vector<std::string> &color, bool in_group = false) {
    addTracks(fourcc);
    addFrames(color, in_group);
    addEnd();
  }
  std::string refusalOfOpen() {
    const std::string path = write();
    return refusal([&] { RecordingReader reader(path); });
  }

  KinectFile file_;
  test::TempFolder folder_;
};

void expectKinectFrames(RecordingReader &reader) {
  ASSERT_EQ(reader.frameCount(), 2u);
  EXPECT_FALSE(reader.worldFromCamera(0)) << "it knows no poses";
  for (uint32_t i = 0; i < 2; ++i) {
    const sphc_localizer_frame frame = reader.read(i);
    EXPECT_EQ(frame.sequence, i);
    EXPECT_EQ(frame.color_time_ns, kKinectStartNs + 33333000 * i) << "by the device's clock";
    EXPECT_EQ(frame.depth_time_ns, frame.color_time_ns + 1000000);
    EXPECT_EQ(static_cast<const uint16_t *>(frame.depth.data)[kDepthPixels - 1], 1000 + i);
  }
}

void expectPixel(RecordingReader &reader, uint32_t index, int red, int green, int blue) {
  const sphc_localizer_frame frame = reader.read(index);
  ASSERT_EQ(frame.color.format, SPHC_FORMAT_BGR8);
  const uint8_t *last = static_cast<const uint8_t *>(frame.color.data) + 3 * (kColorPixels - 1);
  EXPECT_NEAR(last[2], red, 2);
  EXPECT_NEAR(last[1], green, 2);
  EXPECT_NEAR(last[0], blue, 2);
}

TEST_F(AzureKinect, ColourAsMjpg) {
  addRecording("MJPG", {jpegImage(20), jpegImage(60)});
  RecordingReader reader(write());
  expectKinectFrames(reader);
  expectPixel(reader, 0, 110, 25, 20);
  expectPixel(reader, 1, 150, 65, 60);
  EXPECT_FALSE(reader.recording().is_cut);
  EXPECT_EQ(reader.recording().lost_count, 0u);
}

TEST_F(AzureKinect, ColourAsBgra) {
  addRecording("BGRA", {bgraImage(20), bgraImage(60)});
  RecordingReader reader(write());
  expectKinectFrames(reader);
  expectPixel(reader, 1, 150, 65, 60);
}

TEST_F(AzureKinect, ColourAsNv12) {
  addRecording("NV12", {nv12Image(), nv12Image()});
  RecordingReader reader(write());
  expectKinectFrames(reader);
  expectPixel(reader, 0, 193, 70, 93);
}

TEST_F(AzureKinect, ColourAsYuy2) {
  addRecording("YUY2", {yuy2Image(), yuy2Image()});
  RecordingReader reader(write());
  expectKinectFrames(reader);
  expectPixel(reader, 0, 193, 70, 93);
}

// The attached calibration is of the whole sensors; the tracks say which mode was recorded.
TEST_F(AzureKinect, CalibrationOfTheModeThatWasRecorded) {
  addRecording("BGRA", {bgraImage(20), bgraImage(60)});
  RecordingReader reader(write());
  const sphc_rig &rig = reader.calibration();
  EXPECT_EQ(rig.color_camera.width, kColorWidth);
  EXPECT_EQ(rig.color_camera.model, SPHC_CAMERA_BROWN8);
  EXPECT_NEAR(rig.color_camera.params[1], 0.8 * 960, 1e-9);
  EXPECT_NEAR(rig.color_camera.params[3], 0.48 * 960 - 120, 1e-9);
  EXPECT_EQ(rig.depth_camera.height, kDepthHeight);
  EXPECT_NEAR(rig.depth_camera.params[2], 0.51 * 512 - 96, 1e-9);
  EXPECT_NEAR(rig.color_from_depth.t_m[0], -0.032, 1e-9);
  EXPECT_EQ(rig.depth_unit_m, 0.001);
}

// What comes back of the sensor's own light is the amplitude of the depth image of the same time.
TEST_F(AzureKinect, InfraredImagesAreAmplitudes) {
  addTracks("BGRA");
  addFrames({bgraImage(20), bgraImage(60)});
  file_.beginCluster(66666);
  file_.addBlock(kColor, 0, bgraImage(60));
  file_.addBlock(kDepth, 1000, depthImage(1));
  file_.addBlock(3, 999, depthImage(9));
  addEnd();
  RecordingReader reader(write());
  ASSERT_EQ(reader.frameCount(), 3u);
  for (uint32_t i = 0; i < 2; ++i) {
    const sphc_image amplitude = reader.read(i).amplitude;
    ASSERT_EQ(amplitude.format, SPHC_FORMAT_GRAY16);
    EXPECT_EQ(amplitude.width, kDepthWidth);
    EXPECT_EQ(static_cast<const uint16_t *>(amplitude.data)[kDepthPixels - 1], 70 + i);
  }
  EXPECT_EQ(reader.read(2).amplitude.data, nullptr) << "of another time";
}

class KinectAccelerations : public AzureKinect {
 protected:
  KinectAccelerations() { addTracks("BGRA"); }
  // Two blocks of three samples of a camera that is level; the clock of the sensor counts `unit_ns`.
  std::string writeSamples(uint64_t unit_ns, bool of_one_length = true) {
    for (const uint64_t i : {0, 1}) {
      std::vector<std::string> samples;
      for (const uint64_t k : {0, 1, 2})
        samples.push_back(inertialSample((7000000000 + 30000000 * i + 600000 * k) / unit_ns,
                                         {0.25f, static_cast<float>(k), -9.75f}));
      file_.beginCluster(30000 * i);
      file_.addBlock(kColor, 0, bgraImage(20));
      file_.addBlock(kDepth, 0, depthImage(1000));
      file_.addBlock(kInertial, 0, lacedSamples(samples, of_one_length), false, of_one_length ? 0x04 : 0x02);
    }
    return writeEnd();
  }
  std::string writeEnd(const char *accelerometer = kAccelerometer) {
    std::string calibration = host::kAzureKinectFile;
    const std::string none = R"("InertialSensors": [])";
    calibration.replace(calibration.find(none), none.size(), accelerometer);
    file_.attach("calibration.json", calibration);
    file_.tag("K4A_START_OFFSET_NS", std::to_string(kKinectStartNs));
    return write();
  }
  static void expectSamples(const recording::Recording &recording) {
    ASSERT_EQ(recording.accelerations.size(), 6u);
    EXPECT_EQ(recording.lost_count, 0u);
    EXPECT_EQ(recording.bad_acceleration_count, 0u);
    for (size_t i = 0; i < 6; ++i)
      EXPECT_EQ(recording.accelerations[i].time_ns,
                kKinectStartNs + 30000000 * static_cast<int64_t>(i / 3) + 600000 * static_cast<int64_t>(i % 3))
          << i;
    // In the depth image (-1, -9.75, -0.25); the colour camera leans by 37 degrees.
    const double *felt = recording.accelerations[1].felt_mps2;
    EXPECT_NEAR(felt[0], -1, 1e-9);
    EXPECT_NEAR(felt[1], 0.8 * -9.75 + 0.6 * -0.25, 1e-9);
    EXPECT_NEAR(felt[2], -0.6 * -9.75 + 0.8 * -0.25, 1e-9);
  }
};

TEST_F(KinectAccelerations, InNanoseconds) { expectSamples(RecordingReader(writeSamples(1)).recording()); }
TEST_F(KinectAccelerations, InMicroseconds) { expectSamples(RecordingReader(writeSamples(1000)).recording()); }
TEST_F(KinectAccelerations, WithSizes) { expectSamples(RecordingReader(writeSamples(1, false)).recording()); }

// Blocks whose clock begins anew do not change the unit of the others.
TEST_F(KinectAccelerations, BlocksWithAClockOfTheirOwn) {
  file_.beginCluster(0);
  file_.addBlock(kInertial, 0, lacedSamples({inertialSample(1, {1, 2, 3}), inertialSample(600001, {1, 2, 3})}),
                 false, 4);
  for (const int i : {1, 2, 3}) {
    file_.beginCluster(30000u * i);
    file_.addBlock(kColor, 0, bgraImage(20));
    file_.addBlock(kDepth, 0, depthImage(1000));
    const uint64_t time = 7000000000 + 30000000u * static_cast<uint64_t>(i == 3 ? 0 : i);
    file_.addBlock(kInertial, 0,
                   lacedSamples({inertialSample(time, {1, 2, 3}), inertialSample(time + 600000, {1, 2, 3})}), false,
                   4);
  }
  const RecordingReader reader(writeEnd());
  ASSERT_EQ(reader.recording().accelerations.size(), 8u);
  EXPECT_EQ(reader.recording().accelerations[5].time_ns, kKinectStartNs + 60600000);
}

TEST_F(KinectAccelerations, OneABlock) {
  addFrames({bgraImage(20), bgraImage(60)});
  const RecordingReader reader(writeEnd());
  ASSERT_EQ(reader.recording().accelerations.size(), 2u);
  EXPECT_EQ(reader.recording().accelerations[1].time_ns, kKinectStartNs + 33434000);
  EXPECT_NEAR(reader.recording().accelerations[0].felt_mps2[0], -2, 1e-9);
}

TEST_F(KinectAccelerations, WhatIsNoneIsCounted) {
  addFrames({bgraImage(20), bgraImage(60)});
  file_.addBlock(kInertial, 10, "short");
  file_.addBlock(kInertial, 11, inertialSample(1, {1, std::nanf(""), 3}));
  file_.addBlock(kInertial, 9, inertialSample(1, {0, 0, 0}));
  file_.addBlock(kInertial, 1, inertialSample(1, {1, 2, 3}));  // of a time that was
  file_.addBlock(kInertial, 12, lacedSamples({inertialSample(9, {1, 2, 3}), inertialSample(8, {1, 2, 3})}), false,
                 4);
  file_.addBlock(kInertial, 13, "\xFFshort", false, 4);
  const RecordingReader reader(writeEnd());
  EXPECT_EQ(reader.recording().accelerations.size(), 3u);
  EXPECT_EQ(reader.recording().bad_acceleration_count, 1u + 1 + 1 + 1 + 1 + 256);
}

TEST_F(KinectAccelerations, NoneWhereTheCalibrationDoesNotTellTheirAxes) {
  addFrames({bgraImage(20), bgraImage(60)});
  EXPECT_TRUE(RecordingReader(writeEnd(R"("InertialSensors": [])")).recording().accelerations.empty());
}

TEST_F(KinectAccelerations, NoneWithAPlaceThatIsNoRotation) {
  addFrames({bgraImage(20), bgraImage(60)});
  const std::string path =
      writeEnd(R"("InertialSensors": [{"SensorType": "CALIBRATION_InertialSensorType_Accelerometer",
    "Rt": {"Rotation": [1, 0, 0, 0, 1, 0, 0, 0, 2], "Translation": [0, 0, 0]}}])");
  EXPECT_TRUE(RecordingReader(path).recording().accelerations.empty());
}

TEST_F(AzureKinect, BlocksInGroups) {
  addRecording("BGRA", {bgraImage(20), bgraImage(60)}, true);
  RecordingReader reader(write());
  expectKinectFrames(reader);
}

TEST_F(AzureKinect, SizesThatAreNotSaid) {
  addRecording("BGRA", {bgraImage(20), bgraImage(60)});
  RecordingReader reader(write(file_.bytes(true)));
  expectKinectFrames(reader);
  EXPECT_FALSE(reader.recording().is_cut);
}

TEST_F(AzureKinect, FramesOutOfOrderAreSorted) {
  addTracks("BGRA");
  for (const int late : {1, 0}) {
    file_.beginCluster(33333u * late);
    file_.addBlock(kColor, 0, bgraImage(static_cast<uint8_t>(20 + 40 * late)));
    file_.addBlock(kDepth, 1000, depthImage(static_cast<uint16_t>(1000 + late)));
  }
  addEnd();
  RecordingReader reader(write());
  expectKinectFrames(reader);
  expectPixel(reader, 1, 150, 65, 60);
}

TEST_F(AzureKinect, CutFileGivesWhatIsWhole) {
  file_.tag("K4A_START_OFFSET_NS", "5");
  addTracks("BGRA");
  addFrames({bgraImage(20), bgraImage(60)});
  const std::string bytes = file_.bytes();
  const std::string path = write(bytes.substr(0, bytes.size() - 2 * kDepthPixels * 2));  // in the last colour image
  const std::string calibration = folder_ / "rig.json";
  folder_.write("rig.json", R"({"format": "spherecloud-calibration", "version": 1, "pixel_center": 0.5,
    "depth_unit_m": 0.001,
    "color_camera": {"model": "pinhole", "width": 1280, "height": 720, "params": [600, 600, 640, 360]},
    "depth_camera": {"model": "pinhole", "width": 320, "height": 288, "params": [250, 250, 160, 144]},
    "color_from_depth": {"q_wxyz": [1, 0, 0, 0], "t_m": [0, 0, 0]}})");
  recording::ReaderOptions options;
  options.calibration = calibration;
  RecordingReader reader(path, options);
  EXPECT_TRUE(reader.recording().is_cut);
  ASSERT_EQ(reader.frameCount(), 1u) << "tags and calibration come last";
  EXPECT_EQ(reader.read(0).color_time_ns, 0);
  EXPECT_THAT(refusal([&] { RecordingReader again(path); }), HasSubstr("no calibration.json is attached"));
}

TEST_F(AzureKinect, BlocksWithoutATimeAreCountedAsLost) {
  addTracks("BGRA");
  addFrames({bgraImage(20), bgraImage(60)});
  file_.beginCluster(10);
  file_.addBlock(kColor, -11, bgraImage(99));
  file_.beginCluster(UINT64_MAX / 2);
  file_.addBlock(kColor, 0, bgraImage(99));
  addEnd();
  RecordingReader reader(write());
  expectKinectFrames(reader);
  EXPECT_EQ(reader.recording().lost_count, 2u);
}

TEST_F(AzureKinect, BlocksOfSeveralFramesAreCountedAsLost) {
  addTracks("BGRA");
  addFrames({bgraImage(20), bgraImage(60)});
  file_.addBlock(kColor, 500, bgraImage(99), false, 0x02);
  file_.addBlock(9, 500, "a track that is not there");
  addEnd();
  RecordingReader reader(write());
  expectKinectFrames(reader);
  EXPECT_EQ(reader.recording().lost_count, 2u);
}

TEST_F(AzureKinect, WhatIsMissingIsNamed) {
  file_.addTrack({"COLOR", "MJPG", kColorWidth, kColorHeight});
  EXPECT_THAT(refusalOfOpen(), HasSubstr("without a track DEPTH"));
  file_.addTrack({"DEPTH", "b16g", kDepthWidth, kDepthHeight});
  EXPECT_THAT(refusalOfOpen(), HasSubstr("track COLOR has no images"));
  folder_.write("walk.mkv", test::ebml(0x1A45DFA3, ""));
  EXPECT_THAT(refusal([&] { RecordingReader reader(folder_ / "walk.mkv"); }), HasSubstr("is no Matroska file"));
}

TEST_F(AzureKinect, OtherCodingsAreRefused) {
  file_.addTrack({"COLOR", "H264", kColorWidth, kColorHeight});
  file_.addTrack({"DEPTH", "b16g", kDepthWidth, kDepthHeight});
  EXPECT_THAT(refusalOfOpen(), HasSubstr("colour is not MJPG"));
  file_ = {};
  file_.addTrack({"COLOR", "", kColorWidth, kColorHeight, "V_MPEG4/ISO/AVC"});
  EXPECT_THAT(refusalOfOpen(), HasSubstr("track COLOR was encoded again"));
  file_ = {};
  file_.addTrack({"COLOR", "MJPG", kColorWidth, kColorHeight, "V_MS/VFW/FOURCC", test::ebml(0x6D80, "")});
  EXPECT_THAT(refusalOfOpen(), HasSubstr("track COLOR was encoded again"));
}

TEST_F(AzureKinect, ImagesOfAnotherLengthAreRefused) {
  addTracks("BGRA");
  file_.beginCluster(0);
  file_.addBlock(kColor, 0, "short");
  file_.addBlock(kDepth, 0, depthImage(1));
  addEnd();
  RecordingReader reader(write());
  EXPECT_THAT(refusal([&] { reader.read(0); }),
              HasSubstr("is no image of the recording's size (it has more or fewer bytes)"));
}

// Of the one lens that is none of ours; by hand the nearest can be taken.
TEST_F(AzureKinect, LensThatIsNoneOfOursIsRefused) {
  addTracks("BGRA");
  addFrames({bgraImage(20)});
  std::string calibration = host::kAzureKinectFile;
  calibration.replace(calibration.find("BrownConrady"), 12, "Rational6KT");
  file_.attach("calibration.json", calibration);
  EXPECT_THAT(refusalOfOpen(), HasSubstr("Rational6KT is not OpenCV's; take calibration.json out"));
}

TEST_F(AzureKinect, SizesThatTheSensorDoesNotHaveAreRefused) {
  file_.addTrack({"COLOR", "BGRA", 640, 480});
  file_.addTrack({"DEPTH", "b16g", kDepthWidth, kDepthHeight});
  file_.beginCluster(0);
  file_.addBlock(kColor, 0, "x");
  file_.addBlock(kDepth, 0, "x");
  addEnd();
  EXPECT_THAT(refusalOfOpen(), HasSubstr("color images of 640x480: camera 'color' is calibrated for 4096x3072"));
}

}  // namespace
}  // namespace sphc::contract
