#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "host/recording/calibration_json.h"
#include "host/recording/recording_reader.h"
#include "tests/contract/temp_folder.h"
#include "tests/support/hl2ss.h"
#include "tests/support/refusal.h"
#ifdef SPHC_TEST_LIBAVCODEC
#include "tests/support/packet_encoder.h"
#endif

namespace sphc::contract {
namespace {

using recording::RecordingReader;
using test::Hl2ssBytes;
using test::hl2ssShift;
using test::refusal;
using ::testing::HasSubstr;

constexpr uint16_t kVideoWidth = 52, kVideoHeight = 36;
constexpr int kVideoStride = 64;
constexpr int kThrowCols = 320, kThrowRows = 288, kThrowPx = kThrowCols * kThrowRows;
constexpr double kThrowFocal = 200, kThrowCx = 158, kThrowCy = 149;
constexpr uint32_t kVideoFrames = 5;
constexpr uint64_t kBootTicks = 7000000;
constexpr int64_t kBootNs = 700000000;
constexpr uint8_t kH264 = 2, kH265 = 3, kUncoded = 255;

std::string floatBytes(const std::vector<float> &values) {
  return {reinterpret_cast<const char *>(values.data()), values.size() * sizeof(float)};
}

// A lens that draws the rim together, of which one column has no rays.
std::array<double, 2> planePoint(int u, int v) {
  const double x = (u + 0.5 - kThrowCx) / kThrowFocal, y = (v + 0.5 - kThrowCy) / kThrowFocal;
  const double out = 1 + 0.2 * (x * x + y * y);
  return {x * out, y * out};
}
std::string depthTable() {
  std::vector<float> table;
  for (int v = 0; v < kThrowRows; ++v)
    for (int u = 0; u < kThrowCols; ++u)
      for (const double each : planePoint(u, v)) table.push_back(u == 0 ? NAN : static_cast<float>(each));
  return floatBytes(table);
}

// A plane that leans, as ranges along the rays; behind it the infrared image.
double leaningPlaneMm(double x) { return 2000 + 500 * x; }
std::vector<uint16_t> depthAndInfrared() {
  std::vector<uint16_t> both(2 * kThrowPx, 77);
  for (int i = 0; i < kThrowPx; ++i) {
    const auto [x, y] = planePoint(i % kThrowCols, i / kThrowCols);
    both[static_cast<size_t>(i)] =
        static_cast<uint16_t>(std::lround(leaningPlaneMm(x) * std::sqrt(x * x + y * y + 1)));
  }
  return both;
}
std::string uncodedDepth() {
  const std::vector<uint16_t> both = depthAndInfrared();
  return {reinterpret_cast<const char *>(both.data()), both.size() * sizeof(uint16_t)};
}
std::string pngDepth() {
  std::vector<uint16_t> both = depthAndInfrared();
  std::vector<uint8_t> png;
  cv::imencode(".png", cv::Mat(kThrowRows, kThrowCols, CV_8UC4, both.data()), png);
  return {png.begin(), png.end()};
}
// Of one colour; what is beyond a row's end is no image.
std::string nv12Color(uint8_t luma) {
  std::string image;
  for (int row = 0; row < kVideoHeight * 3 / 2; ++row)
    image += std::string(kVideoWidth, static_cast<char>(row < kVideoHeight ? luma : 128)) +
             std::string(kVideoStride - kVideoWidth, '\0');
  return image;
}
uint8_t lumaOf(uint32_t number) { return static_cast<uint8_t>(40 + 30 * number); }
int greyOf(uint32_t number) { return static_cast<int>(std::lround((lumaOf(number) - 16) * 255 / 219.0)); }

// A walk to the right, 10 cm a step of 33 ms.  Axes of the colour camera are right, up, back; the rig's are those
// of the depth camera turned by half a turn, in the same world of y up.
class Hl2ss : public ::testing::Test {
 protected:
  void SetUp() override {
    writeColor(kUncoded, [](uint32_t i) { return nv12Color(lumaOf(i)); });
    writeDepth(kUncoded, uncodedDepth());
    folder_.write("calibration/rm_depth_longthrow/uv2xy.bin", depthTable());
    folder_.write("calibration/rm_depth_longthrow/scale.bin", floatBytes({1000}));
    const test::Hl2ssMatrix depth_from_rig = hl2ssShift(0, 0.02f, 0);
    folder_.write("calibration/rm_depth_longthrow/extrinsics.bin",
                  floatBytes({depth_from_rig.begin(), depth_from_rig.end()}));
  }
  template <typename ImageOf>
  void writeColor(uint8_t profile, ImageOf &&image_of) const {
    Hl2ssBytes file = Hl2ssBytes::ofVideo(kVideoWidth, kVideoHeight, profile);
    for (uint32_t i = 0; i < kVideoFrames; ++i)
      file.addColor(colorTicks(i), image_of(i), {40.0f + static_cast<float>(i), 41, 25.5, 15.5}, kVideoWidth,
                    kVideoHeight, hl2ssShift(0.1f * static_cast<float>(i), 0, 0));
    folder_.write("personal_video.bin", file.bytes());
  }
  void writeDepth(uint32_t profile, const std::string &image, bool is_known = true) const {
    Hl2ssBytes file = Hl2ssBytes::ofDepth(profile);
    for (const uint32_t i : {0u, 3u}) {
      const float x = 0.1f * static_cast<float>(i) + 0.05f + 0.03f;
      const test::Hl2ssMatrix pose = {1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, x, 0.05f, 0, 1};
      file.addDepth(colorTicks(i) + 165000, image, is_known ? pose : test::kHl2ssUnknownPose);
    }
    folder_.write("rm_depth_longthrow.bin", file.bytes());
  }
  static uint64_t colorTicks(uint32_t i) { return kBootTicks + i * 330000; }
  std::string refusalOfOpen() const {
    return refusal([&] { RecordingReader reader(folder_.path()); });
  }
  void expectPlane(const sphc_localizer_frame &frame, const sphc_rig &rig) const {
    const auto *depth = static_cast<const uint16_t *>(frame.depth.data);
    const double *p = rig.depth_camera.params;
    int seen = 0;
    for (int i = 0; i < kThrowPx; ++i) {
      const double x = (i % kThrowCols + 0.5 - p[2]) / p[0];
      if (depth[i] == 0) continue;
      ++seen;
      ASSERT_NEAR(depth[i], leaningPlaneMm(x), 500 / p[0] + 1) << i << ": within a pixel";
    }
    EXPECT_GT(seen, kThrowPx * 19 / 20) << "all but those whose rays are not told";
  }

  TempFolder folder_;
};

TEST_F(Hl2ss, ImagesAndTimes) {
  RecordingReader reader(folder_.path());
  ASSERT_EQ(reader.frameCount(), 4u) << "the two colour images around each of the depth images";
  for (uint32_t i = 0; i < 4; ++i) {
    const sphc_localizer_frame frame = reader.read(i);
    const uint32_t number = i < 2 ? i : i + 1;
    EXPECT_EQ(frame.sequence, number);
    EXPECT_EQ(frame.color_time_ns, kBootNs + number * 33000000);
    EXPECT_EQ(frame.depth_time_ns, kBootNs + (i < 2 ? 0 : 99000000) + 16500000);
    const auto *pixels = static_cast<const uint8_t *>(frame.color.data);
    for (const size_t at : {size_t{0}, size_t{3} * kVideoWidth * kVideoHeight - 1})
      EXPECT_NEAR(pixels[at], greyOf(number), 1) << "no byte from beyond a row";
  }
}

TEST_F(Hl2ss, PosesHaveOurAxes) {
  const RecordingReader reader(folder_.path());
  const std::optional<sphc_rigid> pose = reader.worldFromCamera(1);
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->t_m[0], 0.1, 1e-7);
  const sphc_rigid forward = {{1, 0, 0, 0}, {0, 0, 1}};
  sphc_rigid before;
  sphc_rigid_compose(&*pose, &forward, &before);
  EXPECT_NEAR(before.t_m[2], -1, 1e-9) << "back is z of the colour camera's own axes";
}

TEST_F(Hl2ss, CamerasAndTheTransformBetweenThem) {
  const RecordingReader reader(folder_.path());
  const sphc_rig &rig = reader.calibration();
  EXPECT_EQ(rig.color_camera.params[0], 42) << "the median";
  EXPECT_EQ(rig.color_camera.params[1], 41);
  EXPECT_EQ(rig.color_camera.params[2], 25.5);
  EXPECT_NEAR(rig.depth_camera.params[2], kThrowCx, 0.2);
  // In the world the rig is 3 cm to the right of the colour camera and 5 cm above, the depth camera's centre
  // another 2 cm above it.
  EXPECT_NEAR(rig.color_from_depth.t_m[0], 0.03, 1e-6);
  EXPECT_NEAR(rig.color_from_depth.t_m[1], -0.07, 1e-6);
  EXPECT_NEAR(rig.color_from_depth.t_m[2], 0, 1e-6);
  EXPECT_NEAR(std::abs(rig.color_from_depth.q_wxyz[0]), 1, 1e-9);
}

TEST_F(Hl2ss, DepthUncodedAndAsPng) {
  for (const bool is_png : {false, true}) {
    if (is_png) writeDepth(0, pngDepth());
    RecordingReader reader(folder_.path());
    expectPlane(reader.read(0), reader.calibration());
  }
}

TEST_F(Hl2ss, TheCalibrationLiesInTheRecordingOrInItsFolder) {
  std::filesystem::rename(folder_.path() / "calibration" / "rm_depth_longthrow",
                          folder_.path() / "rm_depth_longthrow");
  EXPECT_EQ(RecordingReader(folder_.path()).frameCount(), 4u);
  std::filesystem::remove_all(folder_.path() / "rm_depth_longthrow");
  EXPECT_THAT(refusalOfOpen(), HasSubstr("no rm_depth_longthrow/uv2xy.bin"));
}

TEST_F(Hl2ss, WithoutPosesItTakesACalibrationFile) {
  writeDepth(kUncoded, uncodedDepth(), false);
  EXPECT_THAT(refusalOfOpen(), HasSubstr("no time at which both know where they are"));
  writeDepth(kUncoded, uncodedDepth());
  Hl2ssBytes file = Hl2ssBytes::ofVideo(kVideoWidth, kVideoHeight, kUncoded, 0);
  std::string held = nv12Color(100) + std::string(80, '\0');
  recording::storeLittle(reinterpret_cast<uint8_t *>(held.data()) + held.size() - 4, kVideoWidth);
  recording::storeLittle(reinterpret_cast<uint8_t *>(held.data()) + held.size() - 2, kVideoHeight);
  file.add(colorTicks(0), held, nullptr);
  folder_.write("personal_video.bin", file.bytes());
  EXPECT_THAT(refusalOfOpen(), HasSubstr("no time at which both know where they are"));
  sphc_rig rig;
  sphc_rig_init(&rig);
  rig.color_camera = {SPHC_CAMERA_PINHOLE, kVideoWidth, kVideoHeight, 4, {40, 40, 26, 18}};
  rig.depth_camera = {SPHC_CAMERA_PINHOLE, kThrowCols, kThrowRows, 4, {200, 200, 160, 144}};
  rig.depth_unit_m = 0.001;
  recording::ReaderOptions options;
  options.calibration = folder_ / "given.json";
  recording::writeCalibration(options.calibration, rig);
  RecordingReader reader(folder_.path(), options);
  ASSERT_EQ(reader.frameCount(), 1u);
  EXPECT_EQ(reader.read(0).depth.width, static_cast<uint32_t>(kThrowCols));
  EXPECT_FALSE(reader.worldFromCamera(0));
}

TEST_F(Hl2ss, AFileThatWasCutGivesWhatIsWhole) {
  const std::string whole = folder_.read("personal_video.bin");
  folder_.write("personal_video.bin", whole.substr(0, whole.size() - 1));
  const RecordingReader reader(folder_.path());
  EXPECT_TRUE(reader.recording().is_cut);
  EXPECT_EQ(reader.recording().color.size(), kVideoFrames - 1);
}

TEST_F(Hl2ss, PacketsThatAreNoImagesAreCounted) {
  Hl2ssBytes file = Hl2ssBytes::ofVideo(kVideoWidth, kVideoHeight, kUncoded);
  const auto add = [&](uint32_t i, uint16_t width) {
    file.addColor(colorTicks(i), nv12Color(90), {40, 41, 25, 15}, width, kVideoHeight, hl2ssShift(0, 0, 0));
  };
  const test::Hl2ssMatrix pose = hl2ssShift(0, 0, 0);
  file.add(colorTicks(0), "short", &pose);
  add(0, kVideoWidth);
  add(0, kVideoWidth);
  add(1, kVideoWidth + 2);
  add(2, kVideoWidth);
  folder_.write("personal_video.bin", file.bytes());
  RecordingReader reader(folder_.path());
  ASSERT_EQ(reader.recording().color.size(), 2u);
  EXPECT_EQ(reader.recording().lost_count, 2u) << "too short, of another size";
  EXPECT_EQ(reader.recording().backward_count, 1u);
  EXPECT_EQ(reader.recording().color[1].sequence, 4u);
}

TEST_F(Hl2ss, ACameraThatIsNotToldIsNamed) {
  Hl2ssBytes file = Hl2ssBytes::ofVideo(kVideoWidth, kVideoHeight, kUncoded);
  for (const uint32_t i : {0u, 1u})
    file.addColor(colorTicks(i), nv12Color(90), {NAN, 41, INFINITY, 15}, kVideoWidth, kVideoHeight,
                  hl2ssShift(0, 0, 0));
  folder_.write("personal_video.bin", file.bytes());
  EXPECT_THAT(refusalOfOpen(), HasSubstr("params[0] is 0"));
}

TEST_F(Hl2ss, WhatIsWrongIsNamed) {
  const std::string color = folder_.read("personal_video.bin"), depth = folder_.read("rm_depth_longthrow.bin");
  const auto refused = [&](const std::string &bytes) {
    folder_.write("personal_video.bin", bytes);
    return refusalOfOpen();
  };
  EXPECT_THAT(refused("RIFF, and more"), HasSubstr("personal_video.bin: is no file of hl2ss"));
  EXPECT_THAT(refused("HL2SS"), HasSubstr("ends within its head"));
  EXPECT_THAT(refused(color.substr(0, 20)), HasSubstr("ends within its head"));
  EXPECT_THAT(refused("HL2SSV99" + color.substr(8)), HasSubstr("another version of hl2ss"));
  EXPECT_THAT(refused(depth), HasSubstr("another stream than its name says"));
  std::string other = color;
  other[8] = '\x01';
  EXPECT_THAT(refused(other), HasSubstr("neither the stream of the colour camera nor of depth"));
  EXPECT_THAT(refused(Hl2ssBytes::ofVideo(kVideoWidth, kVideoHeight, kUncoded, 2).bytes()),
              HasSubstr("mode 0 or 1"));
  EXPECT_THAT(refused(Hl2ssBytes::ofVideo(kVideoWidth, kVideoHeight, kUncoded).bytes()),
              HasSubstr("no whole image"));
  Hl2ssBytes late = Hl2ssBytes::ofVideo(kVideoWidth, kVideoHeight, kUncoded);
  const test::Hl2ssMatrix pose = hl2ssShift(0, 0, 0);
  late.add(UINT64_MAX, "", &pose);
  EXPECT_THAT(refused(late.bytes()), HasSubstr("the time of packet 0 is none"));
  folder_.write("personal_video.bin", color);
  EXPECT_THAT(refusal([&] { RecordingReader reader(folder_.path() / "personal_video.bin"); }),
              HasSubstr("give the folder"));

  const std::string table = "calibration/rm_depth_longthrow/uv2xy.bin",
                    extrinsics = "calibration/rm_depth_longthrow/extrinsics.bin",
                    scale = "calibration/rm_depth_longthrow/scale.bin";
  folder_.write(scale, floatBytes({5000}));
  EXPECT_THAT(refusalOfOpen(), HasSubstr("scale.bin: depth is not in millimetres"));
  folder_.write(extrinsics, floatBytes(std::vector<float>(16, 0)));
  EXPECT_THAT(refusalOfOpen(), HasSubstr("extrinsics.bin: is no rigid transform"));
  folder_.write(extrinsics, "short");
  EXPECT_THAT(refusalOfOpen(), HasSubstr("extrinsics.bin: is too short"));
  folder_.write(table, depthTable().substr(4));
  EXPECT_THAT(refusalOfOpen(), HasSubstr("uv2xy.bin: is not two floats"));
  std::filesystem::remove(folder_ / "rm_depth_longthrow.bin");
  EXPECT_THAT(refusalOfOpen(), HasSubstr("no rm_depth_longthrow.bin; record RM_DEPTH_LONGTHROW too"));
}

TEST_F(Hl2ss, ImagesThatAreNoneAreNamed) {
  const auto refused = [&] {
    RecordingReader reader(folder_.path());
    return refusal([&] { reader.read(0); });
  };
  writeColor(kUncoded, [](uint32_t) { return std::string("short"); });
  EXPECT_THAT(refused(), HasSubstr("(colour 0): is no image of this stream (it has more or fewer bytes)"));
  writeColor(kUncoded, [](uint32_t i) { return nv12Color(lumaOf(i)); });
  writeDepth(kUncoded, "short");
  EXPECT_THAT(refused(), HasSubstr("(depth 0): is no image of this stream"));
  writeDepth(0, "no PNG at all, and longer than its head is");
  EXPECT_THAT(refused(), HasSubstr("(depth 0): "));
  std::vector<uint8_t> png;
  cv::imencode(".png", cv::Mat(8, 8, CV_8UC4, cv::Scalar(1, 2, 3, 4)), png);
  writeDepth(0, {png.begin(), png.end()});
  EXPECT_THAT(refused(), HasSubstr("it has another size"));
  cv::imencode(".png", cv::Mat(kThrowRows, kThrowCols, CV_8UC1, cv::Scalar(1)), png);
  writeDepth(0, {png.begin(), png.end()});
  EXPECT_THAT(refused(), HasSubstr("no PNG image of four channels"));
}

#ifdef SPHC_TEST_LIBAVCODEC
class Hl2ssVideo : public Hl2ss, public ::testing::WithParamInterface<bool> {
 protected:
  void SetUp() override {
    Hl2ss::SetUp();
    std::vector<uint8_t> lumas;
    for (uint32_t i = 0; i < kVideoFrames; ++i) lumas.push_back(lumaOf(i));
    packets_ = test::encodedGreys(GetParam() ? "libx265" : "libx264", kVideoWidth, kVideoHeight, lumas);
    ASSERT_EQ(packets_.size(), kVideoFrames);
    write(packets_);
  }
  void write(const std::vector<std::string> &packets) const {
    writeColor(GetParam() ? kH265 : kH264, [&](uint32_t i) { return packets[i]; });
  }
  static int readGrey(RecordingReader &reader, uint32_t index) {
    return static_cast<const uint8_t *>(reader.read(index).color.data)[0];
  }

  std::vector<std::string> packets_;
};

TEST_P(Hl2ssVideo, EachImageIsThatOfItsPacket) {
  RecordingReader reader(folder_.path());
  ASSERT_EQ(reader.frameCount(), 4u);
  for (const uint32_t i : {0u, 1u, 3u, 2u, 2u, 0u})
    EXPECT_NEAR(readGrey(reader, i), greyOf(i < 2 ? i : i + 1), 3) << i << ": forward, back and again";
}

TEST_P(Hl2ssVideo, BeforeTheFirstThatStandsByItselfThereIsNoImage) {
  std::vector<std::string> later = packets_;
  std::rotate(later.begin(), later.begin() + 1, later.end());  // the first is the last now
  write(later);
  RecordingReader reader(folder_.path());
  EXPECT_THAT(refusal([&] { reader.read(0); }), HasSubstr("(colour 0): cannot be decoded"));
  EXPECT_NEAR(readGrey(reader, 3), greyOf(0), 3);
}

TEST_P(Hl2ssVideo, DamageIsNamedAndNotShown) {
  std::vector<std::string> damaged = packets_;
  damaged[1] = "nothing that was ever encoded";
  write(damaged);
  RecordingReader reader(folder_.path());
  EXPECT_NEAR(readGrey(reader, 0), greyOf(0), 3);
  EXPECT_THAT(refusal([&] { reader.read(1); }), HasSubstr("(colour 1): cannot be decoded"));
  EXPECT_THAT(refusal([&] { reader.read(2); }), HasSubstr("(colour 3): cannot be decoded"))
      << "which goes on from the one that is damaged";
  damaged[4] = packets_[0];
  write(damaged);
  RecordingReader again(folder_.path());
  EXPECT_NEAR(readGrey(again, 3), greyOf(0), 3) << "stands by itself";
}

INSTANTIATE_TEST_SUITE_P(Codes, Hl2ssVideo, ::testing::Bool(),
                         [](const auto &tested) { return tested.param ? "H265" : "H264"; });
#else
TEST_F(Hl2ss, ABuildWithoutLibavcodecSaysSo) {
  writeColor(kH264, [](uint32_t) { return "encoded"; });
  RecordingReader reader(folder_.path());
  EXPECT_THAT(refusal([&] { reader.read(0); }), HasSubstr("install libavcodec-dev"));
}
#endif

}  // namespace
}  // namespace sphc::contract
