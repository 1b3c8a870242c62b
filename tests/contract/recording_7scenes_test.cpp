#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstring>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "host/recording/failure.h"
#include "host/recording/recording.h"
#include "host/recording/writer_7scenes.h"
#include "tests/support/jpeg_frame.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"
#include "tiny_recording.h"

namespace sphc::contract {

namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char *kPose = "0 -1 0 1.5\n1 0 0 -2\n0 0 1 3e-001\t\n0 0 0 1\n";
constexpr const char *kNanPose = "nan nan nan nan\n-1.#IND 0 0 0\ninf 0 0 0\n0 0 0 1\n";

class SevenScenes : public ::testing::Test {
 protected:
  void SetUp() override {
    const sphc_rig calibration = tinyCalibration();
    ASSERT_EQ(sphc_calibration_write((folder_ / "calibration.json").c_str(), &calibration, nullptr), SPHC_OK);
  }

  void addFrame(uint32_t number, const char *pose = kPose, const char *extension = "png") {
    const std::string name = nameOf(number);
    const TinyImages images(number);
    cv::imwrite(folder_ / (name + ".color." + extension),
                cv::Mat(kColorHeight, kColorWidth, CV_8UC3, const_cast<uint8_t *>(images.color.data())));
    cv::imwrite(folder_ / (name + ".depth.png"),
                cv::Mat(kDepthHeight, kDepthWidth, CV_16UC1, const_cast<uint16_t *>(images.depth.data())));
    if (pose) folder_.write(name + ".pose.txt", pose);
  }

  static std::string nameOf(uint32_t number) {
    char name[32];
    std::snprintf(name, sizeof name, "frame-%06u", number);
    return name;
  }

  OpenReplay open(const sphc_replay_config *config = nullptr) const {
    return OpenReplay(folder_.path().string(), nullptr, config);
  }

  test::TempFolder folder_;
};

TEST_F(SevenScenes, TakesNumberAndTimeFromTheFileName) {
  for (const uint32_t number : {3u, 0u, 100u}) addFrame(number);
  const OpenReplay replay = open();
  ASSERT_EQ(replay.status(), SPHC_OK) << replay.message();
  const sphc_replay_info info = infoOf(replay);
  EXPECT_EQ(info.layout, SPHC_REPLAY_7SCENES);
  ASSERT_EQ(sphc_replay_frame_count(replay.get()), 3u);
  const uint32_t numbers[] = {0, 3, 100};
  const int64_t times_ns[] = {0, 100000000, 3333333333};
  for (uint32_t i = 0; i < 3; ++i) {
    sphc_replay_frame_info frame{};
    frame.struct_size = sizeof frame;
    ASSERT_EQ(sphc_replay_get_frame_info(replay.get(), i, &frame), SPHC_OK);
    EXPECT_EQ(frame.sequence, numbers[i]);
    EXPECT_EQ(frame.color_time_ns, times_ns[i]);
    EXPECT_EQ(frame.depth_time_ns, times_ns[i]);
    EXPECT_EQ(frame.has_pose, 1u);
  }
}

// A camera's own count may begin anywhere, and is written as it is.
TEST_F(SevenScenes, TakesTheLargestNumber) {
  for (const uint32_t number : {999999999u, 1000000000u, UINT32_MAX}) addFrame(number);
  const OpenReplay replay = open();
  ASSERT_EQ(replay.status(), SPHC_OK) << replay.message();
  ASSERT_EQ(sphc_replay_frame_count(replay.get()), 3u);
  sphc_replay_frame_info frame{};
  frame.struct_size = sizeof frame;
  ASSERT_EQ(sphc_replay_get_frame_info(replay.get(), 2, &frame), SPHC_OK);
  EXPECT_EQ(frame.sequence, UINT32_MAX);
  EXPECT_EQ(frame.color_time_ns, 143165576500000000);
}

TEST_F(SevenScenes, ReadsPoseMatrices) {
  addFrame(0);
  const OpenReplay replay = open();
  sphc_rigid pose;
  ASSERT_EQ(sphc_replay_pose(replay.get(), 0, &pose), SPHC_OK);
  EXPECT_NEAR(pose.q_wxyz[0], std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(pose.q_wxyz[3], std::sqrt(0.5), 1e-12);
  EXPECT_EQ(pose.t_m[0], 1.5);
  EXPECT_EQ(pose.t_m[2], 0.3);
}

// Every branch of the conversion: half a turn about each axis, and none.
TEST_F(SevenScenes, ReadsHalfTurns) {
  addFrame(0, "1 0 0 0 0 -1 0 0 0 0 -1 0 0 0 0 1");
  addFrame(1, "-1 0 0 0 0 1 0 0 0 0 -1 0 0 0 0 1");
  addFrame(2, "-1 0 0 0 0 -1 0 0 0 0 1 0 0 0 0 1");
  addFrame(3, "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1");
  const OpenReplay replay = open();
  const int one_at[] = {1, 2, 3, 0};
  for (uint32_t i = 0; i < 4; ++i) {
    sphc_rigid pose;
    ASSERT_EQ(sphc_replay_pose(replay.get(), i, &pose), SPHC_OK);
    for (int k = 0; k < 4; ++k) EXPECT_EQ(std::fabs(pose.q_wxyz[k]), k == one_at[i] ? 1 : 0) << i;
  }
}

TEST_F(SevenScenes, SaysHowAPoseIsWrittenWhereNoneIs) {
  addFrame(7, "1,0,0,0\n0,1,0,0\n0,0,1,0\n0,0,0,1\n");
  EXPECT_THAT(recording::openRecording(folder_.path()).pose_fault,
              AllOf(HasSubstr("four rows of four numbers"), HasSubstr("frame-000007.pose.txt")));
  addFrame(8);
  EXPECT_EQ(recording::openRecording(folder_.path()).pose_fault, "");
}

TEST_F(SevenScenes, HasNoPoseWhereTheFileIsBad) {
  addFrame(0, kNanPose);
  addFrame(1, "1 0 0 0\n0 1 0 0\n");                // cut short
  addFrame(2, "2 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1");   // no rotation
  addFrame(3, "1 0 0 0 0 1 0 0 0 0 -1 0 0 0 0 1");  // a mirror
  addFrame(4, "0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0");
  addFrame(5, nullptr);
  addFrame(6);
  sphc_replay_config config = replayConfig();
  config.pose_gap_ns = 0;
  const OpenReplay replay = open(&config);
  ASSERT_EQ(sphc_replay_frame_count(replay.get()), 7u);
  for (uint32_t i = 0; i < 7; ++i) {
    sphc_rigid pose;
    EXPECT_EQ(sphc_replay_pose(replay.get(), i, &pose), i < 6 ? SPHC_NOT_LOCALIZED : SPHC_OK) << i;
    sphc_replay_frame_info frame{};
    frame.struct_size = sizeof frame;
    sphc_replay_get_frame_info(replay.get(), i, &frame);
    EXPECT_EQ(frame.has_pose, i < 6 ? 0u : 1u);
  }
  const sphc_replay_info info = infoOf(replay);
  EXPECT_EQ(info.pose_count, 1u);
  EXPECT_EQ(info.bad_pose_count, 5u);
}

TEST_F(SevenScenes, TakesTheKinects65535ForNoMeasurement) {
  addFrame(0);
  cv::Mat depth(kDepthHeight, kDepthWidth, CV_16UC1, cv::Scalar(1234));
  depth.at<uint16_t>(0, 0) = 65535;
  cv::imwrite(folder_ / "frame-000000.depth.png", depth);
  const OpenReplay replay = open();
  sphc_localizer_frame frame;
  ASSERT_EQ(sphc_replay_read_frame(replay.get(), 0, &frame, nullptr), SPHC_OK);
  EXPECT_EQ(static_cast<const uint16_t *>(frame.depth.data)[0], 0);
  EXPECT_EQ(static_cast<const uint16_t *>(frame.depth.data)[1], 1234);
}

TEST_F(SevenScenes, LeavesAFrameWithoutDepthOut) {
  addFrame(0);
  addFrame(1);
  std::filesystem::remove(folder_ / "frame-000000.depth.png");
  const OpenReplay replay = open();
  ASSERT_EQ(sphc_replay_frame_count(replay.get()), 1u) << "33 ms apart is beyond the tolerance";
}

TEST_F(SevenScenes, GoesOnBehindABadImage) {
  addFrame(0, kPose, "jpg");
  addFrame(1);
  addFrame(2);
  addFrame(3, kPose, "jpg");
  addFrame(4);
  const std::string jpeg = folder_.read("frame-000000.color.jpg");
  folder_.write("frame-000000.color.jpg", jpeg.substr(0, jpeg.size() * 3 / 4));  // libjpeg would fill up with grey
  const std::string png = folder_.read("frame-000001.depth.png");
  folder_.write("frame-000001.depth.png", png.substr(0, png.size() / 2));
  folder_.write("frame-000002.color.png", "");
  std::string spoilt = folder_.read("frame-000004.color.png");
  spoilt[spoilt.size() / 2] = static_cast<char>(~spoilt[spoilt.size() / 2]);
  folder_.write("frame-000004.color.png", spoilt);
  const OpenReplay replay = open();
  const char *named[] = {"frame-000000.color.jpg (colour 0)", "frame-000001.depth.png (depth 1)",
                         "frame-000002.color.png (colour 2)", nullptr, "frame-000004.color.png (colour 4)"};
  for (uint32_t i = 0; i < 5; ++i) {
    sphc_localizer_frame frame;
    sphc_message message{};
    const sphc_status status = sphc_replay_read_frame(replay.get(), i, &frame, &message);
    EXPECT_EQ(status, named[i] ? SPHC_E_DEVICE : SPHC_OK) << i << " " << message.text;
    if (named[i]) {
      EXPECT_THAT(message.text, HasSubstr(named[i]));
    }
  }
}

TEST_F(SevenScenes, NamesDepthOfAnotherKind) {
  addFrame(0);
  const std::string tiff = folder_ / "frame-000000.depth.tiff";
  std::filesystem::rename(folder_ / "frame-000000.depth.png", tiff);
  const auto refused = [this] { return test::refusal([this] { recording::openRecording(folder_.path()); }); };
  EXPECT_THAT(refused(),
              HasSubstr("depth must be PNG of 16 bits in millimetres, and frame-000000.depth.tiff is none"));
  std::filesystem::remove(tiff);
  EXPECT_THAT(refused(), HasSubstr("no frame-*.depth.png; copy them too"));
}

TEST_F(SevenScenes, RefusesADepthImageOfEightBits) {
  addFrame(0);
  cv::imwrite(folder_ / "frame-000000.depth.png", cv::Mat(kDepthHeight, kDepthWidth, CV_8UC1, cv::Scalar(1)));
  const OpenReplay replay = open();
  sphc_localizer_frame frame;
  sphc_message message{};
  EXPECT_EQ(sphc_replay_read_frame(replay.get(), 0, &frame, &message), SPHC_E_IMAGE);
  EXPECT_THAT(message.text, AllOf(HasSubstr("frame-000000.depth.png"), HasSubstr("16-bit")));
}

TEST_F(SevenScenes, RefusesTheColoursOfPrint) {
  addFrame(0, kPose, "jpg");
  const std::vector<uint8_t> jpeg = test::cmykJpeg(kColorWidth, kColorHeight);
  folder_.write("frame-000000.color.jpg", std::string(jpeg.begin(), jpeg.end()));
  const OpenReplay replay = open();
  sphc_localizer_frame frame;
  sphc_message message{};
  EXPECT_EQ(sphc_replay_read_frame(replay.get(), 0, &frame, &message), SPHC_E_IMAGE);
  EXPECT_THAT(message.text, AllOf(HasSubstr("frame-000000.color.jpg"), HasSubstr("CMYK; convert it to RGB")));
}

TEST_F(SevenScenes, RefusesAnImageOfAnotherSize) {
  addFrame(0);
  cv::imwrite(folder_ / "frame-000000.color.png", cv::Mat(10, 20, CV_8UC3, cv::Scalar(1, 2, 3)));
  const OpenReplay replay = open();
  sphc_localizer_frame frame;
  sphc_message message{};
  EXPECT_EQ(sphc_replay_read_frame(replay.get(), 0, &frame, &message), SPHC_E_IMAGE);
  EXPECT_THAT(message.text, AllOf(HasSubstr("is 20 x 10"), HasSubstr("color_camera 48 x 32")));
}

// A quarter of a gigabyte is never made of a few bytes: the header's size decides before anything is decoded.
TEST_F(SevenScenes, RefusesAHugeImageByItsHeader) {
  addFrame(0);
  addFrame(1, kPose, "jpg");
  for (const char *name : {"frame-000000.color.png", "frame-000001.color.jpg"}) {
    const bool is_png = std::string(name).find("png") != std::string::npos;
    std::string image = folder_.read(name);
    const size_t at = is_png ? 16 : image.find("\xff\xc0") + 5;  // of IHDR's width, of SOF0's height
    ASSERT_LT(at, image.size());
    const std::string side = "\x2e\xe0";  // 12000
    const std::string wide = std::string(2, '\0') + side;
    image.replace(at, is_png ? 8 : 4, is_png ? wide + wide : side + side);
    folder_.write(name, image.substr(0, image.size() / 2));  // nor can it be: half of it is missing
  }
  const OpenReplay replay = open();
  for (uint32_t i = 0; i < 2; ++i) {
    sphc_localizer_frame frame;
    sphc_message message{};
    EXPECT_EQ(sphc_replay_read_frame(replay.get(), i, &frame, &message), SPHC_E_IMAGE);
    EXPECT_THAT(message.text, AllOf(HasSubstr("is 12000 x 12000"), HasSubstr("color_camera 48 x 32")));
  }
}

TEST_F(SevenScenes, DecodesATypeUnderItsOwnNameAlone) {
  for (uint32_t i = 0; i < 4; ++i) addFrame(i);
  const cv::Mat image(kColorHeight, kColorWidth, CV_8UC3, cv::Scalar(1, 2, 3));
  const auto bytesAs = [&](const char *extension) {
    std::vector<uchar> bytes;
    cv::imencode(extension, image, bytes);
    return std::string(bytes.begin(), bytes.end());
  };
  folder_.write("frame-000000.color.png", bytesAs(".jpg"));
  folder_.write("frame-000001.color.png", bytesAs(".bmp"));
  folder_.write("frame-000002.color.png", bytesAs(".tiff"));
  std::filesystem::remove(folder_ / "frame-000003.color.png");
  folder_.write("frame-000003.color.jpg", bytesAs(".png"));
  const OpenReplay replay = open();
  for (uint32_t i = 0; i < 4; ++i) {
    sphc_localizer_frame frame;
    sphc_message message{};
    EXPECT_EQ(sphc_replay_read_frame(replay.get(), i, &frame, &message), SPHC_E_DEVICE);
    EXPECT_THAT(message.text, AllOf(HasSubstr(nameOf(i)), HasSubstr(i < 3 ? "is no PNG" : "is no JPEG")));
  }
}

TEST_F(SevenScenes, RefusesWhatIsNoRegularFile) {
  addFrame(0);
  addFrame(1);
  std::filesystem::remove(folder_ / "frame-000000.color.png");
  std::filesystem::remove(folder_ / "frame-000001.depth.png");
  ASSERT_EQ(mkfifo((folder_ / "frame-000000.color.png").c_str(), 0600), 0);
  std::filesystem::create_directory(folder_ / "frame-000001.depth.png");
  {
    const OpenReplay replay = open();
    const char *cause[] = {"frame-000000.color.png (colour 0): is a FIFO",
                           "frame-000001.depth.png (depth 1): is a folder"};
    for (uint32_t i = 0; i < 2; ++i) {
      sphc_localizer_frame frame;
      sphc_message message{};
      EXPECT_EQ(sphc_replay_read_frame(replay.get(), i, &frame, &message), SPHC_E_DEVICE);
      EXPECT_THAT(message.text, HasSubstr(cause[i]));
    }
  }
  std::filesystem::remove(folder_ / "frame-000000.pose.txt");
  ASSERT_EQ(mkfifo((folder_ / "frame-000000.pose.txt").c_str(), 0600), 0);
  const OpenReplay replay = open();
  EXPECT_EQ(replay.status(), SPHC_E_DEVICE);
  EXPECT_THAT(replay.message(), HasSubstr("frame-000000.pose.txt: is a FIFO"));
}

TEST_F(SevenScenes, IsWrittenWholeOrCountsAsUnfinished) {
  const std::string out = folder_ / "out";
  const TinyImages images(7);
  const sphc_localizer_frame frame = tinyFrame(7, images);
  const sphc_rigid pose = tinyPose(7);
  recording::SevenScenesWriter writer(out, tinyCalibration());
  writer.add(frame, &pose);
  EXPECT_THROW(writer.add(frame, &pose), recording::Failure) << "nothing is overwritten";
  {
    const OpenReplay replay(out);
    EXPECT_EQ(replay.status(), SPHC_E_DEVICE);
    EXPECT_THAT(replay.message(), HasSubstr("not finished"));
  }
  EXPECT_THROW(recording::SevenScenesWriter(out, tinyCalibration()), recording::Failure);
  writer.finish();
  const OpenReplay replay(out);
  ASSERT_EQ(replay.status(), SPHC_OK) << replay.message();
  sphc_localizer_frame read;
  ASSERT_EQ(sphc_replay_read_frame(replay.get(), 0, &read, nullptr), SPHC_OK);
  EXPECT_EQ(read.sequence, 7u);
  EXPECT_EQ(std::memcmp(read.color.data, images.color.data(), images.color.size()), 0);
  EXPECT_EQ(std::memcmp(read.depth.data, images.depth.data(), images.depth.size() * 2), 0);
  sphc_rigid read_pose;
  ASSERT_EQ(sphc_replay_pose(replay.get(), 0, &read_pose), SPHC_OK);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(read_pose.q_wxyz[i], pose.q_wxyz[i], 1e-12);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(read_pose.t_m[i], pose.t_m[i]);
}

TEST_F(SevenScenes, RefusesTwoColoursOfOneFrame) {
  addFrame(0);
  addFrame(0, kPose, "jpg");
  const OpenReplay replay = open();
  EXPECT_EQ(replay.status(), SPHC_E_DEVICE);
  EXPECT_THAT(replay.message(), AllOf(HasSubstr("frame-000000.color.png"), HasSubstr("frame-000000.color.jpg")));
}

TEST_F(SevenScenes, AsksForTheSequenceWhenGivenTheScene) {
  std::filesystem::create_directory(folder_ / "seq-01");
  const OpenReplay replay = open();
  EXPECT_EQ(replay.status(), SPHC_E_DEVICE);
  EXPECT_THAT(replay.message(), HasSubstr("give one of its seq-* folders"));
}

TEST_F(SevenScenes, AsksForDepthThatIsMissing) {
  addFrame(0);
  std::filesystem::remove(folder_ / "frame-000000.depth.png");
  const OpenReplay replay = open();
  EXPECT_EQ(replay.status(), SPHC_E_DEVICE);
  EXPECT_THAT(replay.message(), HasSubstr("no frame-*.depth.png"));
}

TEST_F(SevenScenes, ChoosesFramesByTheirNumber) {
  for (uint32_t number = 10; number < 30; ++number) addFrame(number);
  sphc_replay_config config = replayConfig();
  config.first = 12;
  config.last = 25;
  config.step = 5;
  const OpenReplay replay = open(&config);
  const sphc_replay_info info = infoOf(replay);
  EXPECT_EQ(info.color_count, 3u);
  EXPECT_EQ(info.depth_count, 3u);
  for (uint32_t i = 0; i < 3; ++i) {
    sphc_localizer_frame frame;
    ASSERT_EQ(sphc_replay_read_frame(replay.get(), i, &frame, nullptr), SPHC_OK);
    EXPECT_EQ(frame.sequence, 12 + 5 * i);
  }
  config.first = 100;
  config.last = 200;
  const OpenReplay none = open(&config);
  EXPECT_EQ(none.status(), SPHC_E_ARGUMENT);
  EXPECT_THAT(none.message(), AllOf(HasSubstr("first 100, last 200"), HasSubstr("10 to 29")));
}

}  // namespace

}  // namespace sphc::contract
