#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "host/recording/calibration_json.h"
#include "host/recording/recording_reader.h"
#include "tests/support/hl2ss.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"
#ifdef SPHC_TEST_LIBAVCODEC
#include "tests/support/packet_encoder.h"
#endif

namespace sphc::contract {
namespace {

using recording::RecordingReader;
using test::Hl2ssBytes;
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
// Of one colour, U 100 and V 160; what is beyond a row's end is no image.
std::string nv12Color(uint8_t luma) {
  std::string image;
  for (int row = 0; row < kVideoHeight * 3 / 2; ++row) {
    for (int column = 0; column < kVideoWidth; ++column)
      image += static_cast<char>(row < kVideoHeight ? luma : column % 2 == 0 ? 100 : 160);
    image += std::string(kVideoStride - kVideoWidth, '\0');
  }
  return image;
}
uint8_t lumaOf(uint32_t number) { return static_cast<uint8_t>(40 + 30 * number); }
// By BT.601: blue, green, red.
std::array<double, 3> bgrOf(double y, double u, double v) {
  const double light = 1.164 * (y - 16);
  const auto within = [](double x) { return std::min(255.0, std::max(0.0, x)); };
  return {within(light + 2.018 * (u - 128)), within(light - 0.813 * (v - 128) - 0.391 * (u - 128)),
          within(light + 1.596 * (v - 128))};
}

sphc_rigid rigid(std::array<double, 3> rotation_rad, std::array<double, 3> t_m) {
  const double angle = std::hypot(rotation_rad[0], rotation_rad[1], rotation_rad[2]),
               part = std::sin(angle / 2) / angle;
  return {{std::cos(angle / 2), part * rotation_rad[0], part * rotation_rad[1], part * rotation_rad[2]},
          {t_m[0], t_m[1], t_m[2]}};
}
sphc_rigid after(const sphc_rigid &a_from_b, const sphc_rigid &b_from_c) {
  sphc_rigid a_from_c;
  sphc_rigid_compose(&a_from_b, &b_from_c, &a_from_c);
  return a_from_c;
}
const sphc_rigid kColorFromDepth = rigid({0.1, -0.2, 0.05}, {0.03, -0.07, 0.01}),
                 kDepthFromRig = rigid({-0.4, 0.3, 0.2}, {0.01, 0.02, -0.03}),
                 kHalfTurn = {{0, 1, 0, 0}, {0, 0, 0}};
// A walk of 10 cm a step of 33 ms, in our axes.
sphc_rigid worldFromColor(double step) { return rigid({0.5, 0.9, -0.3}, {0.1 * step, 1, 2}); }
test::Hl2ssMatrix colorPose(double step) { return test::hl2ssMatrixOf(after(worldFromColor(step), kHalfTurn)); }

void expectRigid(const sphc_rigid &found, const sphc_rigid &wanted) {
  double alike = 0;
  for (int i = 0; i < 4; ++i) alike += found.q_wxyz[i] * wanted.q_wxyz[i];
  EXPECT_NEAR(std::abs(alike), 1, 1e-9);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(found.t_m[i], wanted.t_m[i], 1e-6) << i;
}

class Hl2ss : public ::testing::Test {
 protected:
  void SetUp() override {
    writeColor(kUncoded, [](uint32_t i) { return nv12Color(lumaOf(i)); });
    writeDepth(kUncoded, uncodedDepth());
    folder_.write("calibration/rm_depth_longthrow/uv2xy.bin", depthTable());
    folder_.write("calibration/rm_depth_longthrow/scale.bin", floatBytes({1000}));
    const test::Hl2ssMatrix depth_from_rig = test::hl2ssMatrixOf(kDepthFromRig);
    folder_.write("calibration/rm_depth_longthrow/extrinsics.bin",
                  floatBytes({depth_from_rig.begin(), depth_from_rig.end()}));
  }
  template <typename ImageOf>
  void writeColor(uint8_t profile, ImageOf &&image_of) const {
    Hl2ssBytes file = Hl2ssBytes::ofVideo(kVideoWidth, kVideoHeight, profile);
    for (uint32_t i = 0; i < kVideoFrames; ++i)
      file.addColor(colorTicks(i), image_of(i), {40.0f + static_cast<float>(i), 41, 25.5, 15.5}, kVideoWidth,
                    kVideoHeight, colorPose(i));
    folder_.write("personal_video.bin", file.bytes());
  }
  void writeDepth(uint32_t profile, const std::string &image, bool is_known = true) const {
    Hl2ssBytes file = Hl2ssBytes::ofDepth(profile);
    for (const uint32_t i : {0u, 3u}) {
      const sphc_rigid world_from_rig = after(after(worldFromColor(i + 0.5), kColorFromDepth), kDepthFromRig);
      file.addDepth(colorTicks(i) + 165000, image,
                    is_known ? test::hl2ssMatrixOf(world_from_rig) : test::kHl2ssUnknownPose);
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

  test::TempFolder folder_;
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
    for (const size_t at : {0, kVideoWidth * kVideoHeight - 1})
      for (size_t channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(pixels[3 * at + channel], bgrOf(lumaOf(number), 100, 160)[channel], 2)
            << "and no byte from beyond a row";
  }
}

TEST_F(Hl2ss, PosesHaveOurAxes) {
  const RecordingReader reader(folder_.path());
  const std::optional<sphc_rigid> pose = reader.worldFromCamera(1);
  ASSERT_TRUE(pose);
  expectRigid(*pose, worldFromColor(1));
}

TEST_F(Hl2ss, CamerasAndTheTransformBetweenThem) {
  const RecordingReader reader(folder_.path());
  const sphc_rig &rig = reader.calibration();
  EXPECT_EQ(rig.color_camera.params[0], 42) << "the median";
  EXPECT_EQ(rig.color_camera.params[1], 41);
  EXPECT_EQ(rig.color_camera.params[2], 25.5);
  EXPECT_NEAR(rig.depth_camera.params[2], kThrowCx, 0.2);
  expectRigid(rig.color_from_depth, kColorFromDepth);
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
    file.addColor(colorTicks(i), nv12Color(90), {40, 41, 25, 15}, width, kVideoHeight, colorPose(0));
  };
  const test::Hl2ssMatrix pose = colorPose(0);
  file.add(colorTicks(0), "short", &pose);
  add(0, kVideoWidth);
  add(0, kVideoWidth);
  add(1, kVideoWidth + 2);
  add(2, kVideoWidth);
  folder_.write("personal_video.bin", file.bytes());
  RecordingReader reader(folder_.path());
  ASSERT_EQ(reader.recording().color.size(), 2u);
  EXPECT_EQ(reader.recording().lost_count, 3u) << "too short, of another size, of a time that was";
  EXPECT_EQ(reader.recording().backward_count, 1u);
  EXPECT_EQ(reader.recording().color[1].sequence, 4u);
}

TEST_F(Hl2ss, ACameraThatIsNotToldIsNamed) {
  Hl2ssBytes file = Hl2ssBytes::ofVideo(kVideoWidth, kVideoHeight, kUncoded);
  for (const uint32_t i : {0u, 1u})
    file.addColor(colorTicks(i), nv12Color(90), {NAN, 41, INFINITY, 15}, kVideoWidth, kVideoHeight, colorPose(0));
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
  EXPECT_THAT(refused(Hl2ssBytes::ofVideo(kVideoWidth, kVideoHeight, 77).bytes()),
              HasSubstr("neither H.264, H.265"));
  Hl2ssBytes old = Hl2ssBytes::ofVideo(kVideoWidth, kVideoHeight, kUncoded);
  old.addColor(colorTicks(0), nv12Color(90), {40, 41, 25, 15}, 0, 0, colorPose(0));
  EXPECT_THAT(refused(old.bytes()), HasSubstr("personal_video.bin: was written by an older hl2ss"));
  Hl2ssBytes late = Hl2ssBytes::ofVideo(kVideoWidth, kVideoHeight, kUncoded);
  const test::Hl2ssMatrix pose = colorPose(0);
  late.add(UINT64_MAX, "", &pose);
  EXPECT_THAT(refused(late.bytes()), HasSubstr("packet 0 has no valid time"));
  folder_.write("personal_video.bin", color);
  EXPECT_THAT(refusal([&] { RecordingReader reader(folder_.path() / "personal_video.bin"); }),
              HasSubstr("give the folder"));

  const std::string table = "calibration/rm_depth_longthrow/uv2xy.bin",
                    extrinsics = "calibration/rm_depth_longthrow/extrinsics.bin",
                    scale = "calibration/rm_depth_longthrow/scale.bin";
  folder_.write(scale, floatBytes({5000}));
  EXPECT_THAT(refusalOfOpen(), HasSubstr("scale.bin: says that depth is not in millimetres"));
  folder_.write(extrinsics, floatBytes(std::vector<float>(16, 0)));
  EXPECT_THAT(refusalOfOpen(), HasSubstr("extrinsics.bin: is no rigid transform"));
  folder_.write(extrinsics, "short");
  EXPECT_THAT(refusalOfOpen(), HasSubstr("extrinsics.bin: is too short"));
  folder_.write(table, depthTable().substr(4));
  EXPECT_THAT(refusalOfOpen(), HasSubstr("uv2xy.bin: is not two floats"));
  folder_.write("rm_depth_longthrow.bin", Hl2ssBytes::ofDepth(0x1234).bytes());
  EXPECT_THAT(refusalOfOpen(), HasSubstr("rm_depth_longthrow.bin: was written by an older hl2ss"));
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
  for (const cv::Mat &other :
       {cv::Mat(8, 8, CV_8UC4, cv::Scalar(1, 2, 3, 4)), cv::Mat(kThrowRows, kThrowCols, CV_8UC1, cv::Scalar(1))}) {
    std::vector<uint8_t> png;
    cv::imencode(".png", other, png);
    writeDepth(0, {png.begin(), png.end()});
    EXPECT_THAT(refused(), HasSubstr("is no PNG image of 320 x 288 and four channels"));
  }
  std::string damaged = pngDepth();
  writeDepth(0, damaged.substr(0, damaged.size() - 12));
  EXPECT_THAT(refused(), HasSubstr("(depth 0): is cut short"));
  for (size_t i = damaged.size() / 2; i < damaged.size() / 2 + 400; ++i) damaged[i] ^= 0x5A;
  writeDepth(0, damaged);
  EXPECT_THAT(refused(), HasSubstr("(depth 0): cannot be decoded"));
}

TEST_F(Hl2ss, ImagesOfOddSidesAndOfTooManyBytesAreNamed) {
  Hl2ssBytes odd = Hl2ssBytes::ofVideo(kVideoWidth, kVideoHeight, kUncoded);
  odd.addColor(colorTicks(0), nv12Color(90), {40, 41, 25, 15}, kVideoWidth - 1, kVideoHeight, colorPose(0));
  odd.addColor(colorTicks(1), std::string((size_t{1} << 26) + 1, 'x'), {40, 41, 25, 15}, kVideoWidth - 1,
               kVideoHeight, colorPose(1));
  folder_.write("personal_video.bin", odd.bytes());
  RecordingReader reader(folder_.path());
  EXPECT_THAT(refusal([&] { reader.read(0); }), HasSubstr("its sides are odd"));
  EXPECT_THAT(refusal([&] { reader.read(1); }), HasSubstr("it is empty or over 64 MiB"));
}

TEST_F(Hl2ss, TheSizeIsThatOfTheImagesNotTheOneAskedFor) {
  Hl2ssBytes file = Hl2ssBytes::ofVideo(1920, 1080, kUncoded);
  for (const uint32_t i : {0u, 1u})
    file.addColor(colorTicks(i), nv12Color(90), {40, 41, 25, 15}, kVideoWidth, kVideoHeight, colorPose(i));
  folder_.write("personal_video.bin", file.bytes());
  EXPECT_EQ(RecordingReader(folder_.path()).read(0).color.width, kVideoWidth);
}

#ifdef SPHC_TEST_LIBAVCODEC
// A texture that moves, in all three planes.
uint8_t texture(int image, int plane, int column, int row) {
  if (plane == 0) return static_cast<uint8_t>(40 + (5 * column + 3 * row + 20 * image) % 160);
  return static_cast<uint8_t>(plane == 1 ? 90 + (3 * column + 7 * image) % 60 : 190 - (4 * row + 5 * image) % 60);
}
// Mean error in grey levels of an image against the texture, of its upper left where the video is larger.
double errorOf(const sphc_localizer_frame &frame, int image) {
  const auto *pixels = static_cast<const uint8_t *>(frame.color.data);
  double sum = 0;
  for (int row = 0; row < kVideoHeight; ++row)
    for (int column = 0; column < kVideoWidth; ++column) {
      const std::array<double, 3> bgr =
          bgrOf(texture(image, 0, column, row), texture(image, 1, column / 2, row / 2),
                texture(image, 2, column / 2, row / 2));
      for (int channel = 0; channel < 3; ++channel)
        sum += std::abs(bgr[static_cast<size_t>(channel)] - pixels[3 * (row * kVideoWidth + column) + channel]);
    }
  return sum / (3.0 * kVideoWidth * kVideoHeight);
}

class Hl2ssVideo : public Hl2ss, public ::testing::WithParamInterface<bool> {
 protected:
  static constexpr double kAlike = 5;  // grey levels

  void SetUp() override {
    if (!test::hasEncoder(settings_.codec)) GTEST_SKIP() << "libavcodec has no " << settings_.codec;
    Hl2ss::SetUp();
    for (const uint32_t i : {0u, 1u, 2u, 3u, 4u}) depth_.addDepth(colorTicks(i), uncodedDepth(), colorPose(i));
    folder_.write("rm_depth_longthrow.bin", depth_.bytes());
    packets_ = test::encodedPackets(settings_, texture);
    ASSERT_EQ(packets_.size(), kVideoFrames);
    write(packets_);
  }
  void write(const std::vector<std::string> &packets) const {
    writeColor(is265() ? kH265 : kH264, [&](uint32_t i) { return packets[i]; });
  }
  static bool is265() { return GetParam(); }
  void expectRefused(RecordingReader &reader, uint32_t index) const {
    EXPECT_THAT(refusal([&] { reader.read(index); }),
                HasSubstr("(colour " + std::to_string(index) + "): cannot be decoded"));
  }

  test::EncoderSettings settings_ = {is265() ? "libx265" : "libx264", kVideoWidth, kVideoHeight, kVideoFrames};
  Hl2ssBytes depth_ = Hl2ssBytes::ofDepth(kUncoded);  // one for each image
  std::vector<std::string> packets_;
};

TEST_P(Hl2ssVideo, EachImageIsThatOfItsPacket) {
  RecordingReader reader(folder_.path());
  ASSERT_EQ(reader.frameCount(), kVideoFrames);
  for (const int i : {0, 1, 4, 2, 2, 3, 0})
    EXPECT_LT(errorOf(reader.read(static_cast<uint32_t>(i)), i), kAlike) << i << ": forward, back and again";
  EXPECT_GT(errorOf(reader.read(1), 2), 2 * kAlike) << "the next one would be told from it";
}

TEST_P(Hl2ssVideo, BeforeTheFirstKeyImageThereIsNone) {
  std::vector<std::string> later = packets_;
  std::rotate(later.begin(), later.begin() + 1, later.end());  // the first is the last now
  write(later);
  RecordingReader reader(folder_.path());
  expectRefused(reader, 0);
  EXPECT_LT(errorOf(reader.read(4), 0), kAlike);
  expectRefused(reader, 3);
  EXPECT_LT(errorOf(reader.read(4), 0), kAlike) << "and again";
}

TEST_P(Hl2ssVideo, DamageIsNamedAndNotShown) {
  std::vector<std::string> damaged = packets_;
  damaged[1] = "nothing that was ever encoded";
  damaged[4] = packets_[0];
  write(damaged);
  for (const bool is_backwards : {false, true}) {
    RecordingReader reader(folder_.path());
    if (is_backwards) {
      EXPECT_LT(errorOf(reader.read(4), 0), kAlike);
    }
    EXPECT_LT(errorOf(reader.read(0), 0), kAlike);
    for (const uint32_t i : {1u, 2u, 3u}) expectRefused(reader, i);
    EXPECT_LT(errorOf(reader.read(4), 0), kAlike) << "stands by itself";
  }
}

TEST_P(Hl2ssVideo, APacketThatIsCutIsNamed) {
  std::vector<std::string> damaged = packets_;
  damaged[2].resize(is265() ? 4 : damaged[2].size() / 2);  // a half of H.265 is one that libavcodec does not notice
  write(damaged);
  RecordingReader reader(folder_.path());
  EXPECT_LT(errorOf(reader.read(1), 1), kAlike);
  for (const uint32_t i : {2u, 3u}) expectRefused(reader, i);
}

TEST_P(Hl2ssVideo, OfALargerVideoTheUpperLeftIsTaken) {
  settings_.width += 12;
  settings_.height += 12;
  write(test::encodedPackets(settings_, texture));
  RecordingReader reader(folder_.path());
  EXPECT_LT(errorOf(reader.read(1), 1), kAlike);
}

TEST_P(Hl2ssVideo, AVideoOfAnotherSizeIsNamed) {
  for (const auto &[width, height, what] :
       {std::tuple(128, 64, "it has another size"), std::tuple(512, 512, "cannot be decoded")}) {
    settings_.width = width;
    settings_.height = height;
    write(test::encodedPackets(settings_, texture));
    RecordingReader reader(folder_.path());
    EXPECT_THAT(refusal([&] { reader.read(0); }), HasSubstr(what));
  }
}

TEST_P(Hl2ssVideo, FullRangeBecomesTheSameColours) {
  settings_.is_full_range = true;
  write(test::encodedPackets(settings_, [](int image, int plane, int column, int row) {
    const uint8_t value = texture(image, plane, column, row);
    return static_cast<uint8_t>(plane == 0 ? std::lround((value - 16) * 255 / 219.0)
                                           : std::lround(128 + (value - 128) * 255 / 224.0));
  }));
  RecordingReader reader(folder_.path());
  EXPECT_LT(errorOf(reader.read(1), 1), kAlike);
}

TEST_P(Hl2ssVideo, ImagesThatGoOnFromLaterOnesAreNamed) {
  settings_.b_frames = 2;
  const std::vector<std::string> packets = test::encodedPackets(settings_, texture);
  ASSERT_EQ(packets.size(), kVideoFrames);
  write(packets);
  RecordingReader reader(folder_.path());
  EXPECT_LT(errorOf(reader.read(0), 0), kAlike);
  int refused = 0;
  for (uint32_t i = 1; i < kVideoFrames; ++i)
    refused += refusal([&] { reader.read(i); }).find("(B frames)") != std::string::npos;
  EXPECT_GE(refused, 2) << "whose images come before that of an earlier packet";
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
