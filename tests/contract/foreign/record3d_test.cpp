#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <opencv2/imgcodecs.hpp>
#ifdef SPHC_TEST_OPENEXR
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#endif

#include "host/recording/foreign/lzfse_bytes.h"
#include "host/recording/foreign/record3d_metadata.h"
#include "host/recording/recording_reader.h"
#include "tests/support/lzfse_samples.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"
#ifdef SPHC_TEST_LIBZIP
#include "tests/support/zip_bytes.h"
#endif

namespace sphc::contract {
namespace {

using recording::RecordingReader;
using test::refusal;
using ::testing::HasSubstr;

// A phone upright: images stand.
constexpr int kRgbCols = 72, kRgbRows = 96, kExrCols = 18, kExrRows = 24;
constexpr size_t kFrameCount = 4;

std::string metadataText(const std::string &more) {
  return R"({"w": 72, "h": 96, "dw": 18, "dh": 24, "fps": 60, "K": [80, 0, 0, 0, 81, 0, 35, 47, 1], )" + more +
         R"("poses": [[0, 0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0, -1], [0, 0, 0, 0, 0, 0, 0],
                      [0, 0.7071067811865476, 0, 0.7071067811865476, 1, 2, 3]]})";
}

TEST(Record3dMetadata, ArkitsAxesBecomeOurs) {
  const recording::Record3dMetadata metadata = recording::record3dMetadataFrom(metadataText(""));
  // ARKit: right, up, back.  A point a metre before the camera lies at z = 1 of ours.
  const auto place = [&](size_t i, double x, double y, double z) {
    const sphc_rigid in_camera = {{1, 0, 0, 0}, {x, y, z}};
    sphc_rigid in_world;
    sphc_rigid_compose(&*metadata.world_from_camera[i], &in_camera, &in_world);
    return std::array<double, 3>{in_world.t_m[0], in_world.t_m[1], in_world.t_m[2]};
  };
  using ::testing::DoubleNear;
  using ::testing::ElementsAre;
  const auto near = [](double x) { return DoubleNear(x, 1e-12); };
  EXPECT_THAT(place(0, 0, 0, 1), ElementsAre(near(0), near(0), near(-1))) << "forward is -z of the world";
  EXPECT_THAT(place(0, 0, 1, 0), ElementsAre(near(0), near(-1), near(0))) << "down";
  EXPECT_THAT(place(0, 1, 0, 0), ElementsAre(near(1), near(0), near(0))) << "right";
  EXPECT_THAT(place(3, 0, 0, 1), ElementsAre(near(0), near(2), near(3))) << "turned left by 90 degrees about y";
  EXPECT_FALSE(metadata.world_from_camera[2]) << "a quaternion of zeros";
}

TEST(Record3dMetadata, CamerasOfFramesGiveTheirMedian) {
  EXPECT_EQ(recording::record3dMetadataFrom(metadataText("")).params, (std::array<double, 4>{80, 81, 35, 47}))
      << "K is told column by column";
  const std::string more = R"("perFrameIntrinsicCoeffs": [[90, 91, 36, 48], [70, 71, 30, 40], [80, 90, 35, 47]], )";
  EXPECT_EQ(recording::record3dMetadataFrom(metadataText(more)).params, (std::array<double, 4>{80, 90, 35, 47}));
}

TEST(Record3dMetadata, TimesAreToldOrByTheRate) {
  EXPECT_EQ(recording::record3dMetadataFrom(metadataText("")).time_ns[3], 50000000);
  const std::string told = R"("frameTimestamps": [5, 5.25, 6, 7], )";
  EXPECT_EQ(recording::record3dMetadataFrom(metadataText(told)).time_ns[1], 5250000000);
}

TEST(Record3dMetadata, WhatIsWrongIsNamed) {
  const auto refused = [](const std::string &text) {
    return refusal([&] { recording::record3dMetadataFrom(text); });
  };
  EXPECT_THAT(refused("[1"), HasSubstr("metadata: is no JSON object"));
  EXPECT_THAT(refused("{}"), HasSubstr("K: expected 9 numbers"));
  EXPECT_THAT(refused(metadataText(R"("frameTimestamps": [1, 2, 2, 3], )")),
              HasSubstr("time does not increase at frame 2"));
  EXPECT_THAT(refused(metadataText(R"("frameTimestamps": [1, 2], )")),
              HasSubstr("frameTimestamps: expected 4 numbers"));
  EXPECT_THAT(refused(metadataText(R"("frameTimestamps": [1, 2, 3, 1e300], )")), HasSubstr("expected seconds"));
  EXPECT_THAT(refused(R"({"K": [1, 0, 0, 0, 1, 0, 1, 1, 1], "w": "a"})"), HasSubstr("w: expected a number over 0"));
  EXPECT_THAT(refused(R"({"K": [1, 0, 0, 0, 1, 0, 1, 1, 1], "w": 4, "h": 4, "poses": []})"), HasSubstr("poses: "));
}

// A zip of some kilobytes holds any of these.
TEST(Record3dMetadata, WhatWouldFillTheMemoryIsRefused) {
  const auto refused = [](const std::string &text) {
    return refusal([&] { recording::record3dMetadataFrom(text); });
  };
  EXPECT_THAT(refused("{\"poses\": " + std::string(100, '[')), HasSubstr("metadata: is nested too deeply"));
  std::string ones = "{\"poses\": [1";
  for (int i = 0; i < 5000000; ++i) ones += ",1";
  EXPECT_THAT(refused(ones + "]}"), HasSubstr("metadata: holds more than an hour of frames has"));
  EXPECT_THAT(refused(std::string((64 << 20) + 1, ' ')), HasSubstr("metadata: is over 64 MiB"));
}

TEST(FilesThatAreNotRead, SayTheWayOut) {
  const test::TempFolder folder;
  const std::pair<std::string, const char *> files[] = {{"#ROSBAG V1.2\n", "rosbag fix"},
                                                        {std::string("SQLite format 3\0", 16), "ros2 bag convert"}};
  for (const auto &[bytes, cure] : files) {
    folder.write("file", bytes);
    EXPECT_THAT(refusal([&] { RecordingReader reader(folder / "file"); }), HasSubstr(cure));
  }
}

TEST(Lzfse, DamagedBytesAreRefused) {
  recording::Bytes out;
  const auto refused = [&](const recording::Bytes &bytes, size_t most) {
    return refusal([&] { recording::decodeLzfse(recording::viewOf(bytes), most, out); });
  };
  const recording::Bytes good = test::lzfseDepth();
  EXPECT_EQ(refused(good, 6912), "");
  EXPECT_EQ(out.size(), 6912u);
  EXPECT_THAT(refused(good, 6911), HasSubstr("is of more than 6911 bytes"));
  for (size_t kept : {size_t{0}, size_t{3}, size_t{20}, good.size() / 2, good.size() - 1})
    EXPECT_THAT(refused({good.begin(), good.begin() + static_cast<ptrdiff_t>(kept)}, 6912), HasSubstr("LZFSE"))
        << kept;
}

// A recording in the app's own form: its files in a folder, or in a zip.
class R3d : public ::testing::TestWithParam<bool> {
 protected:
  R3d() {
    set("metadata", metadataText(""));
    for (size_t i = 0; i < kFrameCount; ++i) {
      const std::string number = "rgbd/" + std::to_string(i);
      recording::Bytes image;
      cv::imencode(".jpg", cv::Mat(kRgbRows, kRgbCols, CV_8UC3, cv::Scalar::all(30.0 * static_cast<double>(i))),
                   image);
      files_[number + ".jpg"] = image;
      files_[number + ".depth"] =
          i == 0 ? test::lzfseDepth() : test::lzfseStored(flatDepth(1 + 0.25f * static_cast<float>(i)));
    }
    files_["rgbd/0.conf"] = test::lzfseConfidence();
  }

  static recording::Bytes flatDepth(float depth_m) {
    recording::Bytes bytes;
    for (size_t i = 0; i < test::kLzfseCols * test::kLzfseRows; ++i)
      recording::append(bytes, &depth_m, sizeof depth_m);
    return bytes;
  }
  // 36 x 48, as the samples are.
  static std::string metadataText(const std::string &more) {
    return R"({"w": 72, "h": 96, )" + more + R"("fps": 60, "K": [80, 0, 0, 0, 81, 0, 35, 47, 1],
               "poses": [[0, 0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0, -1], [0, 0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0, 0]]})";
  }
  void set(const std::string &name, const std::string &text) { files_[name] = {text.begin(), text.end()}; }

  std::string write() const {
#ifdef SPHC_TEST_LIBZIP
    if (GetParam()) {
      const recording::Bytes zip = test::zipOf({files_.begin(), files_.end()});
      folder_.write("walk.r3d", {zip.begin(), zip.end()});
      return folder_ / "walk.r3d";
    }
#endif
    std::filesystem::remove_all(folder_ / "walk");
    for (const auto &[name, bytes] : files_) folder_.write("walk/" + name, {bytes.begin(), bytes.end()});
    return folder_ / "walk";
  }
  std::string refusalOfOpen() const {
    return refusal([&] { RecordingReader reader(write()); });
  }
  std::string refusalOfFrame(uint32_t i) const {
    return refusal([&] { RecordingReader(write()).read(i); });
  }

  test::TempFolder folder_;
  std::map<std::string, recording::Bytes> files_;
};

TEST_P(R3d, ImagesPosesAndCameras) {
  RecordingReader reader(write());
  ASSERT_EQ(reader.frameCount(), kFrameCount);
  const auto *depth = static_cast<const uint16_t *>(reader.read(0).depth.data);
  for (uint32_t y = 0; y < test::kLzfseRows; ++y)
    for (uint32_t x = 0; x < test::kLzfseCols; ++x)
      ASSERT_EQ(depth[test::kLzfseCols * y + x], test::lzfseSampleConfidence(y) ? test::lzfseSampleMm(x, y) : 0)
          << x << ", " << y;
  const sphc_localizer_frame frame = reader.read(2);
  EXPECT_EQ(static_cast<const uint16_t *>(frame.depth.data)[0], 1500) << "no confidence, as of the camera in front";
  EXPECT_NEAR(static_cast<const uint8_t *>(frame.color.data)[0], 60, 2);
  EXPECT_EQ(reader.calibration().color_camera.params[1], 81);
  EXPECT_DOUBLE_EQ(reader.calibration().depth_camera.params[1], 40.5);
  EXPECT_EQ(reader.worldFromCamera(1)->t_m[2], -1);
}

TEST_P(R3d, ImagesBeyondThePosesAreCountedAsLost) {
  files_["rgbd/4.jpg"] = files_["rgbd/5.jpg"] = files_["rgbd/3.jpg"];
  EXPECT_EQ(RecordingReader(write()).recording().lost_count, 2u);
}

TEST_P(R3d, ACalibrationStandsInForACameraThatIsNone) {
  std::string text = metadataText("");
  text.replace(text.find("80, 0"), 2, "-8");
  set("metadata", text);
  EXPECT_THAT(refusalOfOpen(), HasSubstr("a focal length must be positive"));
  folder_.write("rig.json", R"({"format": "spherecloud-calibration", "version": 1, "pixel_center": 0.5,
    "depth_unit_m": 0.001,
    "color_camera": {"model": "pinhole", "width": 72, "height": 96, "params": [80, 80, 36, 48]},
    "depth_camera": {"model": "pinhole", "width": 36, "height": 48, "params": [40, 40, 18, 24]},
    "color_from_depth": {"q_wxyz": [1, 0, 0, 0], "t_m": [0, 0, 0]}})");
  recording::ReaderOptions options;
  options.calibration = folder_ / "rig.json";
  RecordingReader reader(write(), options);
  EXPECT_EQ(static_cast<const uint16_t *>(reader.read(2).depth.data)[0], 1500);
}

TEST_P(R3d, AnEmptyConfidenceIsNone) {
  files_["rgbd/0.conf"].clear();
  RecordingReader reader(write());
  EXPECT_EQ(static_cast<const uint16_t *>(reader.read(0).depth.data)[0], test::lzfseSampleMm(0, 0));
}

TEST_P(R3d, DepthHasTheShapeThatIsTold) {
  set("metadata", metadataText(R"("dw": 36, "dh": 48, )"));
  EXPECT_EQ(RecordingReader(write()).calibration().depth_camera.height, 48u);
  set("metadata", metadataText(R"("dw": 30, "dh": 48, )"));
  EXPECT_THAT(refusalOfOpen(), HasSubstr("rgbd/0.depth: its 6912 bytes are no image of the shape"));
  set("metadata", metadataText(R"("dw": 0, "dh": 48, )"));
  EXPECT_THAT(refusalOfOpen(), HasSubstr("dw: expected a number over 0"));
}

TEST_P(R3d, FramesWithoutAPartnerAreNone) {
  files_.erase("rgbd/1.depth");
  files_.erase("rgbd/2.jpg");
  const RecordingReader reader(write());
  ASSERT_EQ(reader.frameCount(), 2u);
  EXPECT_EQ(reader.colorOf(1).sequence, 3u);
  EXPECT_EQ(reader.recording().lost_count, 1u) << "the colour image";
}

TEST_P(R3d, WhatIsDamagedIsNamed) {
  files_["rgbd/1.conf"] = test::lzfseStored({1, 2, 3});
  EXPECT_THAT(refusalOfFrame(1), HasSubstr("its confidence, rgbd/1.conf: has 3 pixels"));
  files_["rgbd/1.depth"].resize(500);
  EXPECT_THAT(refusalOfFrame(1), HasSubstr("cannot be decoded as LZFSE"));
  recording::Bytes small = flatDepth(1);
  small.resize(small.size() / 2);
  files_["rgbd/1.depth"] = test::lzfseStored(small);
  EXPECT_THAT(refusalOfFrame(1), HasSubstr("has 864 pixels"));
  files_["rgbd/0.depth"].resize(500);
  EXPECT_THAT(refusalOfOpen(), HasSubstr("rgbd/0.depth: cannot be decoded as LZFSE"));
}

INSTANTIATE_TEST_SUITE_P(Folder, R3d, ::testing::Values(false));
#ifdef SPHC_TEST_LIBZIP
INSTANTIATE_TEST_SUITE_P(Zip, R3d, ::testing::Values(true));

class ZippedR3d : public R3d {};

TEST_P(ZippedR3d, ADamagedZipIsNamed) {
  const std::string path = write(), good = folder_.read("walk.r3d");
  folder_.write("walk.r3d", good.substr(0, good.size() / 2));
  EXPECT_THAT(refusal([&] { RecordingReader reader(path); }), HasSubstr("walk.r3d: cannot be read as a zip ("));
  const size_t image = good.find("rgbd/1.jpg");
  for (size_t i = image + 30; i < image + 60; ++i) {  // in what is compressed
    std::string changed = good;
    changed[i] ^= 1;
    folder_.write("walk.r3d", changed);
    RecordingReader reader(path);
    EXPECT_EQ(refusal([&] { reader.read(0); }), "");
    EXPECT_THAT(refusal([&] { reader.read(1); }),
                AllOf(HasSubstr("rgbd/1.jpg"), HasSubstr("copy"), HasSubstr("zip")));
  }
}

TEST_P(ZippedR3d, AnyOtherZipIsRefused) {
  files_.erase("metadata");
  EXPECT_THAT(refusalOfOpen(), HasSubstr("none of Record3D's"));
}

INSTANTIATE_TEST_SUITE_P(Zip, ZippedR3d, ::testing::Values(true));
#else
TEST(R3dWithoutLibzip, IsRefused) {
  const test::TempFolder folder;
  folder.write("walk.r3d", std::string("PK\x03\x04") + std::string(30, '\0'));
  EXPECT_THAT(refusal([&] { RecordingReader reader(folder / "walk.r3d"); }), HasSubstr("install libzip-dev"));
}
#endif

#ifdef SPHC_TEST_OPENEXR
void writeExr(const std::string &path, const char *channel, Imf::PixelType type,
              const std::vector<float> &depth_m) {
  Imf::Header header(kExrCols, kExrRows);
  header.channels().insert(channel, Imf::Channel(type));
  std::vector<half> halves(depth_m.begin(), depth_m.end());
  const size_t bytes = type == Imf::FLOAT ? sizeof(float) : sizeof(half);
  char *pixels = type == Imf::FLOAT ? reinterpret_cast<char *>(const_cast<float *>(depth_m.data()))
                                    : reinterpret_cast<char *>(halves.data());
  Imf::FrameBuffer frame;
  frame.insert(channel, Imf::Slice(type, pixels, bytes, bytes * kExrCols));
  Imf::OutputFile file(path.c_str(), header);
  file.setFrameBuffer(frame);
  file.writePixels(kExrRows);
}

class Record3d : public ::testing::TestWithParam<const char *> {
 protected:
  void SetUp() override {
    folder_.write(inner() + "metadata.json", metadataText(""));
    for (size_t i = 0; i < kFrameCount; ++i) {
      std::vector<float> depth(kExrCols * kExrRows, 1.5f + 0.25f * static_cast<float>(i));
      depth[0] = std::nanf("");
      folder_.write(inner() + "depth/" + std::to_string(i) + ".exr", "");
      writeExr(file("depth", i, ".exr"), i % 2 ? "Y" : "R", i % 2 ? Imf::HALF : Imf::FLOAT, depth);
      folder_.write(inner() + "rgb/" + std::to_string(i) + ".jpg", "");
      cv::imwrite(file("rgb", i, ".jpg"),
                  cv::Mat(kRgbRows, kRgbCols, CV_8UC3, cv::Scalar::all(30.0 * static_cast<double>(i))));
    }
  }
  std::string inner() const { return GetParam(); }
  std::string file(const char *kind, size_t i, const char *ending) const {
    return folder_ / (inner() + kind + "/" + std::to_string(i) + ending);
  }
  std::string refusalOfOpen() const {
    return refusal([&] { RecordingReader reader(folder_.path()); });
  }

  test::TempFolder folder_;
};

TEST_P(Record3d, ImagesPosesAndCameras) {
  RecordingReader reader(folder_.path());
  ASSERT_EQ(reader.frameCount(), kFrameCount);
  for (uint32_t i = 0; i < kFrameCount; ++i) {
    const sphc_localizer_frame frame = reader.read(i);
    const auto *depth = static_cast<const uint16_t *>(frame.depth.data);
    EXPECT_EQ(depth[0], 0);
    EXPECT_EQ(depth[1], 1500 + 250 * i);
    EXPECT_EQ(depth[kExrCols * kExrRows - 1], 1500 + 250 * i);
    EXPECT_NEAR(static_cast<const uint8_t *>(frame.color.data)[0], 30 * i, 2);
    EXPECT_EQ(frame.sequence, i);
  }
  EXPECT_EQ(reader.calibration().color_camera.params[1], 81);
  EXPECT_DOUBLE_EQ(reader.calibration().depth_camera.params[1], 20.25);
  EXPECT_EQ(reader.recording().bad_pose_count, 1u);
  EXPECT_EQ(reader.worldFromCamera(1)->t_m[2], -1);
}

TEST_P(Record3d, FramesWithoutAPartnerAreNone) {
  std::filesystem::remove(file("depth", 1, ".exr"));
  std::filesystem::remove(file("rgb", 2, ".jpg"));
  const RecordingReader reader(folder_.path());
  ASSERT_EQ(reader.frameCount(), 2u);
  EXPECT_EQ(reader.colorOf(1).sequence, 3u);
  EXPECT_EQ(reader.recording().lost_count, 1u) << "the colour image";
}

TEST_P(Record3d, WhatIsDamagedIsNamed) {
  RecordingReader reader(folder_.path());
  const std::string name = inner() + "depth/2.exr", good = folder_.read(name);
  folder_.write(name, good.substr(0, good.size() / 2));
  EXPECT_THAT(refusal([&] { reader.read(2); }), HasSubstr("cannot be decoded as OpenEXR"));
  folder_.write(name, "");
  EXPECT_THAT(refusal([&] { reader.read(2); }), HasSubstr("cannot be decoded as OpenEXR"));
  cv::imwrite(file("rgb", 0, ".jpg"), cv::Mat(kRgbCols, kRgbRows, CV_8UC3, cv::Scalar::all(1)));
  EXPECT_THAT(refusalOfOpen(), HasSubstr("neither turned nor scaled"));
  std::filesystem::remove_all(folder_ / (inner() + "rgb"));
  std::filesystem::create_directories(folder_ / (inner() + "rgb"));
  EXPECT_THAT(refusalOfOpen(), HasSubstr("no rgb/0.jpg"));
}

INSTANTIATE_TEST_SUITE_P(Folders, Record3d, ::testing::Values("", "EXR_RGBD/"));
#endif

}  // namespace
}  // namespace sphc::contract
