#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "host/recording/calibration_json.h"
#include "tests/support/nobody.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"
#include "tiny_recording.h"

namespace sphc::contract {

namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class Tum : public ::testing::Test {
 protected:
  void SetUp() override { writeTinyRecording(folder_.path().string(), 6); }

  OpenReplay open(const sphc_replay_config *config = nullptr) const {
    return OpenReplay(folder_.path().string(), nullptr, config);
  }
  void expectRefused(sphc_status status, const char *text) const {
    const OpenReplay replay = open();
    EXPECT_EQ(replay.status(), status);
    EXPECT_THAT(replay.message(), HasSubstr(text));
  }

  test::TempFolder folder_;
};

TEST_F(Tum, KeepsEveryNanosecond) {
  folder_.write("rgb.txt",
                "# comment\r\n\r\n1305031102.175304123 rgb/000000.png\r\n1305031102.2  rgb/000001.png \r\n");
  const OpenReplay replay = open();
  ASSERT_EQ(replay.status(), SPHC_OK) << replay.message();
  sphc_localizer_frame frame;
  ASSERT_EQ(sphc_replay_read_frame(replay.get(), 0, &frame, nullptr), SPHC_OK);
  EXPECT_EQ(frame.color_time_ns, 1305031102175304123);
  EXPECT_EQ(frame.depth_time_ns, 1305031102175304123 + kDepthLagNs);
}

TEST_F(Tum, ReadsPosesAsNumpyAndEvoWriteThem) {
  folder_.write(
      "groundtruth.txt",
      "1.700000010300000000e+09 1.000000000000000000e+00 0.000000000000000000e+00 -2.500000000000000000e-01 "
      "0.000000000000000000e+00 0.000000000000000000e+00 0.000000000000000000e+00 1.000000000000000000e+00\n");
  const OpenReplay replay = open();
  ASSERT_EQ(replay.status(), SPHC_OK) << replay.message();
  sphc_rigid pose;
  ASSERT_EQ(sphc_replay_pose_at(replay.get(), 1700000010300000000, &pose), SPHC_OK);
  EXPECT_EQ(pose.t_m[2], -0.25);
}

TEST_F(Tum, EndingsOfNamesMayBeInCapitals) {
  std::filesystem::rename(folder_ / "rgb/000000.png", folder_ / "rgb/IMG_0.PNG");
  folder_.write("rgb.txt", "1305031102.175304123 rgb/IMG_0.PNG\n");
  const OpenReplay replay = open();
  sphc_localizer_frame frame;
  sphc_message message{};
  EXPECT_EQ(sphc_replay_read_frame(replay.get(), 0, &frame, &message), SPHC_OK) << message.text;
}

TEST_F(Tum, PairsWithTheNearestDepth) {
  folder_.write("rgb.txt", "1.000 rgb/000000.png\n1.100 rgb/000001.png\n1.200 rgb/000002.png\n");
  folder_.write("depth.txt",
                "0.990 depth/000000.png\n1.005 depth/000001.png\n1.121 depth/000002.png\n1.220 depth/000003.png\n");
  const OpenReplay replay = open();
  ASSERT_EQ(sphc_replay_frame_count(replay.get()), 2u) << "21 ms is beyond the 20 ms of the config, 20 ms is not";
  const int64_t depth_ns[] = {1005000000, 1220000000};
  for (uint32_t i = 0; i < 2; ++i) {
    sphc_replay_frame_info info{};
    info.struct_size = sizeof info;
    sphc_replay_get_frame_info(replay.get(), i, &info);
    EXPECT_EQ(info.depth_time_ns, depth_ns[i]);
    EXPECT_EQ(info.sequence, 2 * i);
  }
}

TEST_F(Tum, InterpolatesPosesAcrossSmallGapsOnly) {
  folder_.write("groundtruth.txt",
                "1.00 0 0 0 0 0 0 1\n"
                "1.04 1 2 4 0 0 -0.70710678118654752 -0.70710678118654752\n"  // a quarter turn about z, other sign
                "1.20 0 0 0 0 0 0 1\n");
  const OpenReplay replay = open();
  sphc_rigid pose;
  ASSERT_EQ(sphc_replay_pose_at(replay.get(), 1000000000, &pose), SPHC_OK);
  EXPECT_EQ(pose.q_wxyz[0], 1) << "exact";
  ASSERT_EQ(sphc_replay_pose_at(replay.get(), 1010000000, &pose), SPHC_OK);
  const double half_angle = std::acos(-1.0) / 16;
  EXPECT_NEAR(pose.q_wxyz[0], std::cos(half_angle), 1e-12);
  EXPECT_NEAR(pose.q_wxyz[3], std::sin(half_angle), 1e-12);
  EXPECT_NEAR(pose.t_m[2], 1, 1e-12);
  EXPECT_EQ(sphc_replay_pose_at(replay.get(), 1100000000, &pose), SPHC_NOT_LOCALIZED) << "gap of 160 ms";
  EXPECT_EQ(sphc_replay_pose_at(replay.get(), 999998999, &pose), SPHC_NOT_LOCALIZED) << "before the first";
  EXPECT_EQ(sphc_replay_pose_at(replay.get(), 1200001001, &pose), SPHC_NOT_LOCALIZED) << "behind the last";
}

TEST_F(Tum, PosesKeepTheirImagesWhenADoubleRoundedTheirTimes) {
  folder_.write("rgb.txt", "1700000010.3 rgb/000000.png\n1700000010.4 rgb/000001.png\n");
  folder_.write("groundtruth.txt", "1700000010.299999952 1 0 0 0 0 0 1\n1700000010.400000095 2 0 0 0 0 0 1\n");
  const OpenReplay replay = open();
  for (const int64_t time_ns : {1700000010300000000, 1700000010400000000}) {
    sphc_rigid pose;
    ASSERT_EQ(sphc_replay_pose_at(replay.get(), time_ns, &pose), SPHC_OK);
    EXPECT_EQ(pose.t_m[0], time_ns == 1700000010300000000 ? 1 : 2);
  }
}

TEST_F(Tum, LeavesBadPosesOut) {
  folder_.write("groundtruth.txt", "1 nan 0 0 0 0 0 1\n2 0 0 0 0 0 0 0\n3 0 0 0 0 0 0 1.02\n4 0 0 0 0 0 0 1\n");
  const OpenReplay replay = open();
  const sphc_replay_info info = infoOf(replay);
  EXPECT_EQ(info.pose_count, 1u);
  EXPECT_EQ(info.bad_pose_count, 3u);
}

TEST_F(Tum, OfPosesOfOneTimeTheFirstCountsAndTheOthersAreCounted) {
  folder_.write("groundtruth.txt", "1 5 0 0 0 0 0 1\n1 6 0 0 0 0 0 1\n1 7 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n");
  const OpenReplay replay = open();
  const sphc_replay_info info = infoOf(replay);
  EXPECT_EQ(info.pose_count, 2u);
  EXPECT_EQ(info.bad_pose_count, 2u);
  sphc_rigid pose;
  ASSERT_EQ(sphc_replay_pose_at(replay.get(), 1000000000, &pose), SPHC_OK);
  EXPECT_EQ(pose.t_m[0], 5);
}

TEST_F(Tum, APoseOfMoreNumbersIsOfAnotherFormat) {
  folder_.write("groundtruth.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 0\n");
  expectRefused(SPHC_E_ARGUMENT,
                "groundtruth.txt, line 1: has more than 8 numbers, as KITTI's 12 without a time; "
                "expected \"seconds tx ty tz qx qy qz qw\"");
}

TEST_F(Tum, DoesWithoutGroundTruth) {
  std::filesystem::remove(folder_ / "groundtruth.txt");
  const OpenReplay replay = open();
  ASSERT_EQ(replay.status(), SPHC_OK);
  sphc_rigid pose;
  EXPECT_EQ(sphc_replay_pose(replay.get(), 0, &pose), SPHC_NOT_LOCALIZED);
}

TEST_F(Tum, ReadsAnInterruptedRecording) {
  folder_.write("rgb.txt", folder_.read("rgb.txt") + "13050311");
  folder_.write("groundtruth.txt", folder_.read("groundtruth.txt") + "1305031199.5 1 2 3");
  const OpenReplay replay = open();
  ASSERT_EQ(replay.status(), SPHC_OK) << replay.message();
  EXPECT_EQ(sphc_replay_frame_count(replay.get()), 6u);
}

TEST_F(Tum, ListsMayBeginWithAByteOrderMark) {
  for (const char *list : {"rgb.txt", "depth.txt", "groundtruth.txt"})
    folder_.write(list, "\xEF\xBB\xBF" + folder_.read(list));
  const OpenReplay replay = open();
  ASSERT_EQ(replay.status(), SPHC_OK) << replay.message();
  EXPECT_EQ(sphc_replay_frame_count(replay.get()), 6u);
}

TEST_F(Tum, AListInUtf16IsNamed) {
  folder_.write("rgb.txt", std::string("\xFF\xFEx\0", 4));
  expectRefused(SPHC_E_ARGUMENT, "rgb.txt: is in UTF-16; save it as UTF-8");
}

TEST_F(Tum, NamesTheLineThatIsWrong) {
  const std::string good = folder_.read("rgb.txt");
  folder_.write("rgb.txt", "1.0 rgb/000000.png\nx rgb/000001.png\n");
  expectRefused(SPHC_E_ARGUMENT, "rgb.txt, line 2: expected \"seconds file\"");
  folder_.write("rgb.txt", "1.0\n");
  expectRefused(SPHC_E_ARGUMENT, "rgb.txt, line 1");
  folder_.write("rgb.txt", "2.0 rgb/000000.png\n2.0 rgb/000001.png\n");
  expectRefused(SPHC_E_ARGUMENT, "rgb.txt, line 2: time does not increase");
  folder_.write("rgb.txt", "# nothing\n");
  expectRefused(SPHC_E_DEVICE, "names no image");
  folder_.write("rgb.txt", good);
  folder_.write("groundtruth.txt", "2 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n");
  expectRefused(SPHC_E_ARGUMENT, "groundtruth.txt, line 2: time decreases");
  folder_.write("groundtruth.txt", "1 0 0 0 0 0 1\n");
  expectRefused(SPHC_E_ARGUMENT, "groundtruth.txt, line 1");
  std::filesystem::remove(folder_ / "depth.txt");
  expectRefused(SPHC_E_DEVICE, "depth.txt: cannot be read");
}

TEST_F(Tum, NamesTimesBelowZero) {
  const std::string good = folder_.read("rgb.txt");
  folder_.write("rgb.txt", "-0.5 rgb/000000.png\n");
  expectRefused(SPHC_E_ARGUMENT,
                "rgb.txt, line 1: expected \"seconds file\", and -0.5 is below 0; add the same to the times of");
  folder_.write("rgb.txt", good);
  folder_.write("groundtruth.txt", "-5e-2 0 0 0 0 0 0 1\n");
  expectRefused(SPHC_E_ARGUMENT,
                "groundtruth.txt, line 1: expected \"seconds tx ty tz qx qy qz qw\", and -5e-2 is");
  folder_.write("groundtruth.txt", "-x 0 0 0 0 0 0 1\n");
  expectRefused(SPHC_E_ARGUMENT, "expected \"seconds tx ty tz qx qy qz qw\"");
}

TEST_F(Tum, NamesTheUnitOfTimesThatAreNotInSeconds) {
  folder_.write("rgb.txt", "1305031102175304123 rgb/000000.png\n");
  expectRefused(SPHC_E_ARGUMENT,
                "rgb.txt, line 1: expected \"seconds file\", and 1305031102175304123 is too large for seconds: it "
                "looks like nanoseconds; divide the times by 1000000000");
  folder_.write("rgb.txt", "1305031102175304.5 rgb/000000.png\n");
  expectRefused(SPHC_E_ARGUMENT, "microseconds; divide the times by 1000000");
  folder_.write("rgb.txt", "1.305031102175304123e+18 rgb/000000.png\n");
  expectRefused(SPHC_E_ARGUMENT, "nanoseconds; divide the times by 1000000000");
  folder_.write("rgb.txt", "1305031102175 rgb/000000.png\n");
  expectRefused(SPHC_E_ARGUMENT, "milliseconds; divide the times by 1000");
  folder_.write("rgb.txt", "9199999999 rgb/000000.png\n9300000000 rgb/000001.png\n");
  expectRefused(SPHC_E_ARGUMENT, "rgb.txt, line 2: expected \"seconds file\", and 9300000000 is");
  folder_.write("rgb.txt", "1305031102.175\n");
  expectRefused(SPHC_E_ARGUMENT, "line 1: expected \"seconds file\"");
  folder_.write("rgb.txt", "1305031102.175 rgb/000000.png\n");
  folder_.write("groundtruth.txt", "1305031102175304123 0 0 0 0 0 0 1\n");
  expectRefused(SPHC_E_ARGUMENT, "groundtruth.txt, line 1: expected \"seconds tx ty tz qx qy qz qw\", and 1305");
}

TEST_F(Tum, ReadsNothingOutsideItsFolder) {
  const test::TempFolder elsewhere;
  std::filesystem::copy(folder_ / "rgb/000000.png", elsewhere / "secret.png");
  std::filesystem::create_directory_symlink(elsewhere.path(), folder_ / "way");
  std::filesystem::create_symlink(elsewhere / "secret.png", folder_ / "rgb/link.png");
  const std::string good = "1.0 rgb/000000.png\n";
  folder_.write("rgb.txt", good + "2.0 rgb/../../secret.png\n");
  expectRefused(SPHC_E_ARGUMENT, "rgb.txt, line 2: rgb/../../secret.png: the file's path goes upwards");
  folder_.write("rgb.txt", "# x\n" + good + "2.0 /etc/passwd\n");
  expectRefused(SPHC_E_ARGUMENT, "rgb.txt, line 3: /etc/passwd: the file's path is absolute");
  for (const char *file : {"way/secret.png", "rgb/link.png"}) {
    folder_.write("rgb.txt", good + "2.0 " + file + "\n");
    expectRefused(SPHC_E_ARGUMENT,
                  (std::string("rgb.txt, line 2: ") + file + ": the file is a link out of").c_str());
  }
  // A link that stays inside is as good as a copy, and so is the folder itself under another name.
  std::filesystem::create_symlink(folder_ / "rgb/000000.png", folder_ / "rgb/inside.png");
  folder_.write("rgb.txt", "1.0 rgb/inside.png\n");
  std::filesystem::create_directory_symlink(folder_.path(), elsewhere / "alias");
  const OpenReplay replay(elsewhere / "alias");
  EXPECT_EQ(replay.status(), SPHC_OK) << replay.message();
}

// Nobody may look into a temporary folder of another user.
TEST_F(Tum, AFolderThatMayNotBeReadIsNamed) {
  const std::string name = std::filesystem::path(folder_.path()).filename().string();
  std::filesystem::permissions(folder_.path(), std::filesystem::perms::owner_read);
  {
    const test::Nobody nobody;
    expectRefused(SPHC_E_DEVICE, (name + ": cannot be read: Permission denied; check its permissions").c_str());
    EXPECT_THAT(test::refusal([&] { recording::readCalibration(folder_ / "calibration.json"); }),
                HasSubstr("calibration.json: no calibration file: cannot be read: Permission denied"));
  }
  std::filesystem::permissions(folder_.path(), std::filesystem::perms::owner_all);
}

TEST_F(Tum, RefusesWhatIsNoRegularFile) {
  std::filesystem::remove(folder_ / "rgb/000001.png");
  ASSERT_EQ(mkfifo((folder_ / "rgb/000001.png").c_str(), 0600), 0);
  {
    const OpenReplay replay = open();
    sphc_localizer_frame frame;
    sphc_message message{};
    EXPECT_EQ(sphc_replay_read_frame(replay.get(), 1, &frame, &message), SPHC_E_DEVICE);
    EXPECT_THAT(message.text, HasSubstr("rgb/000001.png (colour 1): is a FIFO"));
  }
  std::filesystem::remove(folder_ / "groundtruth.txt");
  ASSERT_EQ(mkfifo((folder_ / "groundtruth.txt").c_str(), 0600), 0);
  expectRefused(SPHC_E_DEVICE, "groundtruth.txt: is a FIFO");
}

TEST_F(Tum, ChoosesFramesByTheirPlaceAndDepthWithThem) {
  sphc_replay_config config = replayConfig();
  config.first = 1;
  config.step = 2;
  const OpenReplay replay = open(&config);
  const sphc_replay_info info = infoOf(replay);
  EXPECT_EQ(info.color_count, 3u);
  EXPECT_EQ(info.depth_count, 3u);
  sphc_source source;
  sphc_replay_source(replay.get(), &source);
  ASSERT_EQ(source.start(source.self), SPHC_OK);
  for (uint32_t i = 0; i < 6; ++i) {
    sphc_capture capture = {};
    capture.struct_size = sizeof capture;
    ASSERT_EQ(source.acquire(source.self, 0, &capture), SPHC_OK);
    EXPECT_EQ(capture.sequence, 1 + i / 2 * 2);
    EXPECT_EQ(capture.stream, i % 2 == 0 ? SPHC_STREAM_COLOR : SPHC_STREAM_DEPTH);
    source.release(source.self, &capture);
  }
}

TEST_F(Tum, GoesOnBehindAMissingImage) {
  std::filesystem::remove(folder_ / "depth/000001.png");
  const OpenReplay replay = open();
  sphc_source source;
  sphc_replay_source(replay.get(), &source);
  ASSERT_EQ(source.start(source.self), SPHC_OK);
  for (uint32_t i = 0; i < 12; ++i) {
    sphc_capture capture = {};
    capture.struct_size = sizeof capture;
    const sphc_status status = source.acquire(source.self, 0, &capture);
    ASSERT_EQ(status, i == 3 ? SPHC_E_DEVICE : SPHC_OK) << i;
    if (i == 3) {
      EXPECT_THAT(source.message(source.self), HasSubstr("depth/000001.png (depth 1): cannot be read"));
    }
    if (status == SPHC_OK) source.release(source.self, &capture);
  }
  sphc_capture capture = {};
  capture.struct_size = sizeof capture;
  EXPECT_EQ(source.acquire(source.self, 0, &capture), SPHC_END);
}

}  // namespace

}  // namespace sphc::contract
