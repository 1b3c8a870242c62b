#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "host/recording/foreign/depth_lut.h"
#include "host/recording/foreign/pgm.h"
#include "host/recording/foreign/stream_recorder_text.h"
#include "host/recording/recording_reader.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace sphc::contract {
namespace {

using recording::RecordingReader;
using test::refusal;
using ::testing::HasSubstr;

constexpr int kPvCols = 48, kPvRows = 32, kTofCols = 64, kTofRows = 56;
constexpr double kTofFocal = 60, kTofCx = 33, kTofCy = 27;
constexpr uint32_t kPvFrames = 5;
constexpr uint64_t kFirstTicks = 132697151403874938;  // in the year 2021
constexpr int64_t kFirstNs = 1625241540387493800;

// A lens that draws the rim together: the ray of a pixel is further out than a pinhole's.
std::array<double, 3> tofRay(int u, int v) {
  const double x = (u + 0.5 - kTofCx) / kTofFocal, y = (v + 0.5 - kTofCy) / kTofFocal;
  const double out = 1 + 0.3 * (x * x + y * y), norm = std::sqrt(out * out * (x * x + y * y) + 1);
  return {x * out / norm, y * out / norm, 1 / norm};
}

std::string tofTable() {
  std::string bytes;
  for (int v = 0; v < kTofRows; ++v)
    for (int u = 0; u < kTofCols; ++u)
      for (const double each : tofRay(u, v)) {
        const float value = u == 0 ? 0.0f : static_cast<float>(each);  // a column without rays
        bytes.append(reinterpret_cast<const char *>(&value), sizeof value);
      }
  return bytes;
}

// A plane that leans: z = 2 m + 0.5 m for each metre to the right on the plane at 1.
double planeMm(double x) { return 2000 + 500 * x; }

std::string tofImage() {
  std::string image = "P5\n" + std::to_string(kTofCols) + " " + std::to_string(kTofRows) + "\n65535\n";
  for (int v = 0; v < kTofRows; ++v)
    for (int u = 0; u < kTofCols; ++u) {
      const std::array<double, 3> ray = tofRay(u, v);
      const auto range = static_cast<uint16_t>(std::lround(planeMm(ray[0] / ray[2]) / ray[2]));
      image += {static_cast<char>(range >> 8), static_cast<char>(range & 255)};
    }
  return image;
}

// Row by row, no rotation.
std::string matrixText(double x, double y, double z) {
  return "1,0,0," + std::to_string(x) + ",0,1,0," + std::to_string(y) + ",0,0,1," + std::to_string(z) + ",0,0,0,1";
}

// A walk to the right, 10 cm a step of 33 ms.  Axes of the colour camera are right, up, back; the rig's are those
// of the depth camera, right, down, forward, in the same world of y up.
class StreamRecorder : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pv = "25.5,15.5," + std::to_string(kPvCols) + "," + std::to_string(kPvRows) + "\n";
    for (uint32_t i = 0; i < kPvFrames; ++i) {
      const uint64_t ticks = kFirstTicks + i * 330000;
      pv += std::to_string(ticks) + "," + std::to_string(40 + i) + ",41," + matrixText(0.1 * i, 0, 0) + "\n";
      folder_.write(pvName(i), "");
      cv::imwrite(folder_ / pvName(i), cv::Mat(kPvRows, kPvCols, CV_8UC3, cv::Scalar(10 * i, 20, 30)));
    }
    folder_.write("2021-07-02-155900_pv.txt", pv);
    folder_.write(sensor("_lut.bin"), tofTable());
    folder_.write(sensor("_extrinsics.txt"), matrixText(0, 0.02, 0));  // depth_from_rig
    std::string rig;
    for (const uint32_t i : {0u, 3u}) {
      const uint64_t ticks = depthTicks(i);
      rig += std::to_string(ticks) + ",1,0,0," + std::to_string(0.1 * i + 0.05 + 0.03) +
             ",0,-1,0,0.05,0,0,-1,0,0,0,0,1\n";
      folder_.write(depthName(i), tofImage());
      folder_.write("Depth Long Throw/" + std::to_string(ticks) + "_ab.pgm", tofImage());
    }
    folder_.write(sensor("_rig2world.txt"), rig);
  }
  static std::string sensor(const char *ending) { return std::string("Depth Long Throw") + ending; }
  static uint64_t depthTicks(uint32_t i) { return kFirstTicks + i * 330000 + 165000; }
  static std::string depthName(uint32_t i) { return "Depth Long Throw/" + std::to_string(depthTicks(i)) + ".pgm"; }
  static std::string pvName(uint32_t i) { return "PV/" + std::to_string(kFirstTicks + i * 330000) + ".png"; }
  std::string refusalOfOpen() const {
    return refusal([&] { RecordingReader reader(folder_.path()); });
  }

  test::TempFolder folder_;
};

TEST_F(StreamRecorder, ImagesAndTimes) {
  RecordingReader reader(folder_.path());
  ASSERT_EQ(reader.frameCount(), 4u) << "the two colour images around each of the depth images";
  EXPECT_EQ(reader.recording().depth.size(), 2u) << "infrared images are none";
  for (uint32_t i = 0; i < 4; ++i) {
    const sphc_localizer_frame frame = reader.read(i);
    const uint32_t number = i < 2 ? i : i + 1;
    EXPECT_EQ(frame.sequence, number);
    EXPECT_EQ(frame.color_time_ns, kFirstNs + number * 33000000);
    EXPECT_EQ(frame.depth_time_ns, kFirstNs + (i < 2 ? 0 : 99000000) + 16500000);
    EXPECT_EQ(static_cast<const uint8_t *>(frame.color.data)[0], 10 * number);
  }
}

TEST_F(StreamRecorder, RawColourHasAFourthChannel) {
  std::filesystem::remove(folder_ / pvName(0));
  std::string raw;
  for (int i = 0; i < kPvCols * kPvRows; ++i) raw += "\x01\x02\x03\xFF";
  const std::string name = pvName(0).substr(0, pvName(0).size() - 3) + "bytes";
  folder_.write(name, raw);
  RecordingReader reader(folder_.path());
  const auto *pixels = static_cast<const uint8_t *>(reader.read(0).color.data);
  EXPECT_EQ(pixels[3], 1);
  EXPECT_EQ(pixels[4], 2);
  EXPECT_EQ(pixels[5], 3);
  folder_.write(name, raw.substr(4));
  EXPECT_THAT(refusal([&] { reader.read(0); }), HasSubstr("is not four bytes for each pixel"));
}

TEST_F(StreamRecorder, PosesHaveOurAxes) {
  const RecordingReader reader(folder_.path());
  const std::optional<sphc_rigid> pose = reader.worldFromCamera(1);
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->t_m[0], 0.1, 1e-9);
  const sphc_rigid forward = {{1, 0, 0, 0}, {0, 0, 1}};
  sphc_rigid before;
  sphc_rigid_compose(&*pose, &forward, &before);
  EXPECT_NEAR(before.t_m[2], -1, 1e-9) << "back is z of the colour camera's own axes";
}

TEST_F(StreamRecorder, CamerasAndTheTransformBetweenThem) {
  const RecordingReader reader(folder_.path());
  const sphc_rig &rig = reader.calibration();
  EXPECT_EQ(rig.color_camera.params[0], 42) << "the median";
  EXPECT_EQ(rig.color_camera.params[1], 41);
  EXPECT_EQ(rig.color_camera.params[2], 25.5);
  EXPECT_NEAR(rig.depth_camera.params[2], kTofCx, 0.2);
  // In the world the rig is 3 cm to the right of the colour camera and 5 cm above, the depth camera's centre
  // another 2 cm above it.
  EXPECT_NEAR(rig.color_from_depth.t_m[0], 0.03, 1e-6);
  EXPECT_NEAR(rig.color_from_depth.t_m[1], -0.07, 1e-6);
  EXPECT_NEAR(rig.color_from_depth.t_m[2], 0, 1e-6);
  EXPECT_NEAR(std::abs(rig.color_from_depth.q_wxyz[0]), 1, 1e-9);
}

TEST_F(StreamRecorder, DepthAlongRaysBecomesAPinholeCameras) {
  RecordingReader reader(folder_.path());
  const auto *depth = static_cast<const uint16_t *>(reader.read(0).depth.data);
  const double *p = reader.calibration().depth_camera.params;
  int seen = 0;
  for (int v = 0; v < kTofRows; ++v)
    for (int u = 0; u < kTofCols; ++u) {
      const double x = (u + 0.5 - p[2]) / p[0];
      if (depth[v * kTofCols + u] == 0) continue;
      ++seen;
      EXPECT_NEAR(depth[v * kTofCols + u], planeMm(x), 500 / p[0]) << u << " " << v << ": within a pixel";
    }
  EXPECT_GT(seen, kTofCols * kTofRows * 19 / 20) << "all but those whose rays are not told";
}

TEST_F(StreamRecorder, WhatIsWrongIsNamed) {
  RecordingReader reader(folder_.path());
  folder_.write(depthName(0), tofImage().substr(0, 5000));
  EXPECT_THAT(refusal([&] { reader.read(0); }), HasSubstr("is cut short"));
  EXPECT_THAT(refusalOfOpen(), HasSubstr(".pgm: is cut short"));
  folder_.write(depthName(0), "P5\n64 56\n255\n");
  EXPECT_THAT(refusalOfOpen(), HasSubstr("is no PGM image of 16 bits"));
  folder_.write(depthName(0), tofImage());
  folder_.write(sensor("_lut.bin"), tofTable().substr(4));
  EXPECT_THAT(refusalOfOpen(), HasSubstr("_lut.bin: is not three floats"));
  folder_.write(sensor("_lut.bin"), std::string(tofTable().size(), '\0'));
  EXPECT_THAT(refusalOfOpen(), HasSubstr("_lut.bin: its rays are those of no camera"));
  folder_.write(sensor("_lut.bin"), tofTable());
  folder_.write(sensor("_extrinsics.txt"), "1,0,0\n");
  EXPECT_THAT(refusalOfOpen(), HasSubstr("_extrinsics.txt: line 1: expected the 16 numbers"));
  std::filesystem::remove_all(folder_ / "PV");
  EXPECT_THAT(refusalOfOpen(), HasSubstr("unpack PV.tar into a folder of that name"));
  std::filesystem::remove(folder_ / "2021-07-02-155900_pv.txt");
  EXPECT_THAT(refusalOfOpen(), HasSubstr("no *_pv.txt"));
}

TEST_F(StreamRecorder, AHeadsetThatNeverKnewItsPlaceHasNoTransform) {
  folder_.write(sensor("_rig2world.txt"), std::to_string(depthTicks(0)) + ",0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0\n");
  EXPECT_THAT(refusalOfOpen(), HasSubstr("no time at which both know where they are"));
}

TEST(StreamRecorderText, WhatIsWrongIsNamed) {
  const std::string head = "1,2,3,4\n", frame = std::to_string(kFirstTicks) + ",5,6," + matrixText(0, 0, 0) + "\n";
  const auto refused = [](const std::string &text) { return refusal([&] { recording::pvFileFrom(text); }); };
  EXPECT_THAT(refused("1,2,3\n"), HasSubstr("line 1: expected the principal point"));
  EXPECT_THAT(refused(head), HasSubstr("line 1: no line of a frame follows"));
  EXPECT_THAT(refused(head + "7,5,6," + matrixText(0, 0, 0) + "\n"), HasSubstr("line 2: expected a time"));
  EXPECT_THAT(refused(head + frame + frame), HasSubstr("line 3: time does not increase"));
  EXPECT_EQ(recording::pvFileFrom(head + frame + "1326971").frames.size(), 1u) << "what a crash leaves behind";
}

TEST(StreamRecorderText, ACrashAmidALineOfRigPosesCostsThatLineAlone) {
  const auto line = [](uint32_t i) { return std::to_string(kFirstTicks + i) + "," + matrixText(0.1 * i, 0, 0); };
  const auto poses = [](const std::string &text) { return recording::rigTrackFrom(text).poses().size(); };
  const std::string two = line(0) + "\n" + line(1), last = line(2);
  EXPECT_EQ(poses(two), 2u) << "nothing but the end of the last line is missing";
  for (const size_t bytes : {size_t{1}, size_t{17}, last.find(',') + 1, last.rfind(',')})
    EXPECT_EQ(poses(two + "\n" + last.substr(0, bytes)), 2u) << last.substr(0, bytes);
  EXPECT_THAT(refusal([&] { poses(two + "\n1326971\n"); }), HasSubstr("line 3: expected a time"));
}

}  // namespace
}  // namespace sphc::contract
