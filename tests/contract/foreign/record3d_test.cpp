#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#ifdef SPHC_TEST_OPENEXR
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#endif

#include "host/recording/foreign/record3d_metadata.h"
#include "host/recording/recording_reader.h"
#include "tests/contract/temp_folder.h"
#include "tests/support/refusal.h"

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

TEST(FilesThatAreNotRead, SayTheWayOut) {
  const TempFolder folder;
  const std::pair<std::string, const char *> files[] = {
      {std::string("PK\x03\x04") + std::string(30, '\0'), "EXR + RGB"},
      {"#ROSBAG V1.2\n", "rosbag fix"},
      {std::string("SQLite format 3\0", 16), "ros2 bag convert"}};
  for (const auto &[bytes, cure] : files) {
    folder.write("file", bytes);
    EXPECT_THAT(refusal([&] { RecordingReader reader(folder / "file"); }), HasSubstr(cure));
  }
  folder.write("r3d/metadata", "{}");
  std::filesystem::create_directories(folder / "r3d/rgbd");
  EXPECT_THAT(refusal([&] { RecordingReader reader(folder / "r3d"); }), HasSubstr("unpacked .r3d"));
}

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

  TempFolder folder_;
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
