// The video of a recording of StrayScanner.
#ifdef SPHC_TEST_LIBAVFORMAT

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#ifdef SPHC_TEST_VIDEOIO
#include <opencv2/videoio.hpp>
#endif

#include "host/recording/foreign/video.h"
#include "tests/support/mp4_encoder.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace sphc::contract {
namespace {

using recording::Video;
using test::refusal;
using ::testing::AnyOf;
using ::testing::HasSubstr;

constexpr int kShotCols = 128, kShotRows = 96;
constexpr uint32_t kShotFrames = 24;
constexpr const char *kLost = "cannot be decoded: the video ends or is damaged before it; copy it again";

// Every frame is brighter than the one before, and no two steps are the same.
uint8_t pixelOf(int image, int plane, int column, int row) {
  const int step =
      plane > 0 ? 118 + image * image * 11 % 20 : 30 + 6 * image + (column + row) % 16 + 20 * (row < 16);
  return static_cast<uint8_t>(step);
}

struct Coding {
  const char *codec;
  int b_frames;
  bool is_full_range = false;
};

class StrayVideo : public ::testing::TestWithParam<Coding> {
 protected:
  void SetUp() override {
    if (!test::hasEncoder(GetParam().codec)) GTEST_SKIP() << "libavcodec has no " << GetParam().codec;
    encode();
  }
  void encode(bool is_head_first = true) {
    test::writeMp4(path_,
                   {GetParam().codec, kShotCols, kShotRows, int{kShotFrames}, 8, GetParam().b_frames,
                    GetParam().is_full_range},
                   pixelOf, is_head_first);
  }
  std::string refusalOfOpen() {
    return refusal([&] { Video video(path_); });
  }

  test::TempFolder folder_;
  const std::string path_ = folder_ / "rgb.mp4";
};
INSTANTIATE_TEST_SUITE_P(Codings, StrayVideo,
                         ::testing::Values(Coding{"libx264", 0}, Coding{"libx264", 3}, Coding{"libx264", 3, true},
                                           Coding{"libx265", 0}, Coding{"libx265", 3}, Coding{"mpeg4", 0}));

std::string bytesOf(const sphc_image &image) {
  std::string bytes;
  for (uint32_t row = 0; row < image.height; ++row)
    bytes.append(static_cast<const char *>(image.data) + size_t{row} * image.stride_bytes, size_t{image.width} * 3);
  return bytes;
}

std::vector<std::string> framesOf(const std::string &path) {
  Video video(path);
  std::vector<std::string> frames;
  for (uint32_t i = 0; i < video.frameCount(); ++i) frames.push_back(bytesOf(video.read(i)));
  return frames;
}

TEST_P(StrayVideo, FramesComeInTheOrderInWhichTheyAreShown) {
  Video video(path_);
  EXPECT_EQ(video.width(), static_cast<uint32_t>(kShotCols));
  EXPECT_EQ(video.height(), static_cast<uint32_t>(kShotRows));
  ASSERT_EQ(video.frameCount(), kShotFrames);
  double before = 0;
  for (uint32_t i = 0; i < kShotFrames; ++i) {
    const sphc_image image = video.read(i);
    const auto *bgr = static_cast<const uint8_t *>(image.data) + size_t{40} * image.stride_bytes + 3 * 40;
    const double brightness = 0.114 * bgr[0] + 0.587 * bgr[1] + 0.299 * bgr[2];
    EXPECT_GT(brightness, before) << "frame " << i;
    before = brightness;
  }
  EXPECT_THAT(refusal([&] { video.read(kShotFrames); }), kLost);
}

TEST_P(StrayVideo, FramesInAnyOrderAreTheSame) {
  const std::vector<std::string> frames = framesOf(path_);
  Video video(path_);
  for (const uint32_t i : {17u, 17u, 3u, 23u, 0u, 9u, 8u, 7u, 16u, 15u})
    EXPECT_EQ(bytesOf(video.read(i)), frames[i]) << "frame " << i;
}

#ifdef SPHC_TEST_VIDEOIO
TEST_P(StrayVideo, PixelsAreThoseOfOpenCv) {
  cv::VideoCapture peer(path_, cv::CAP_FFMPEG);
  Video video(path_);
  EXPECT_EQ(peer.get(cv::CAP_PROP_FRAME_COUNT), video.frameCount());
  cv::Mat frame;
  for (uint32_t i = 0; i < kShotFrames; ++i) {
    ASSERT_TRUE(peer.read(frame));
    EXPECT_EQ(bytesOf(video.read(i)), std::string(frame.datastart, frame.dataend)) << "frame " << i;
  }
}
#endif

// A player turns the picture by the matrix of its track; the depth beside it is as the sensor lies.
TEST_P(StrayVideo, IsNotTurned) {
  const std::vector<std::string> frames = framesOf(path_);
  std::string file = folder_.read("rgb.mp4");
  const std::string quarter = {0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, '\xFF', '\xFF', 0, 0, 0, 0, 0, 0};
  folder_.write("rgb.mp4", file.replace(file.find("tkhd") + 44, quarter.size(), quarter));
#ifdef SPHC_TEST_VIDEOIO
  EXPECT_EQ(cv::VideoCapture(path_, cv::CAP_FFMPEG).get(cv::CAP_PROP_FRAME_WIDTH), kShotRows)
      << "the matrix counts";
#endif
  EXPECT_EQ(framesOf(path_), frames);
}

// What is left of it is as it was; the head of one that was cut is often behind its images, and then nothing is.
TEST_P(StrayVideo, ACutOneEndsEarlier) {
  const std::vector<std::string> frames = framesOf(path_);
  const std::string file = folder_.read("rgb.mp4");
  folder_.write("rgb.mp4", file.substr(0, file.size() * 3 / 4));
  Video video(path_);
  uint32_t read_count = 0;
  for (uint32_t i = 0; i < kShotFrames; ++i) {
    const std::string refused = refusal([&] {
      EXPECT_EQ(bytesOf(video.read(i)), frames[i]) << "frame " << i;
      ++read_count;
    });
    EXPECT_THAT(refused, AnyOf("", kLost));
  }
  EXPECT_GT(read_count, kShotFrames / 4);
  EXPECT_LT(read_count, kShotFrames);
  encode(false);
  folder_.write("rgb.mp4", folder_.read("rgb.mp4").substr(0, file.size() / 2));
  EXPECT_THAT(refusalOfOpen(), HasSubstr("rgb.mp4: cannot be decoded; copy the video again"));
}

// Where each packet lies, by the demuxer itself.
struct PacketBytes {
  size_t at, size;
};
std::vector<PacketBytes> packetsOf(const std::string &path) {
  AVFormatContext *file = nullptr;
  EXPECT_EQ(avformat_open_input(&file, path.c_str(), nullptr, nullptr), 0);
  AVPacket *packet = av_packet_alloc();
  std::vector<PacketBytes> packets;
  for (; av_read_frame(file, packet) == 0; av_packet_unref(packet))
    packets.push_back({static_cast<size_t>(packet->pos), static_cast<size_t>(packet->size)});
  av_packet_free(&packet);
  avformat_close_input(&file);
  return packets;
}

// No decoder makes an image of a packet of zeros.  Those from it to the next key image are refused, and no other
// takes the number of one that is lost.
TEST_P(StrayVideo, ALostPacketMovesNoOtherFrame) {
  const std::vector<std::string> frames = framesOf(path_);
  const std::string whole = folder_.read("rgb.mp4");
  const std::vector<PacketBytes> packets = packetsOf(path_);
  ASSERT_EQ(packets.size(), size_t{kShotFrames});
  for (size_t lost = 0; lost < packets.size(); ++lost) {
    std::string damaged = whole;
    folder_.write("rgb.mp4", damaged.replace(packets[lost].at, packets[lost].size, packets[lost].size, '\0'));
    Video video(path_);
    int refused_count = 0;
    for (uint32_t i = 0; i < kShotFrames; ++i) {
      const std::string refused = refusal(
          [&] { EXPECT_EQ(bytesOf(video.read(i)), frames[i]) << "frame " << i << " without packet " << lost; });
      refused_count += !refused.empty();
    }
    EXPECT_GE(refused_count, 1) << "without packet " << lost;
    EXPECT_LE(refused_count, 16) << "without packet " << lost;
  }
}

// kShotFrames where it is none of them.
uint32_t numberOf(const std::string &frame, const std::vector<std::string> &frames) {
  return static_cast<uint32_t>(std::find(frames.begin(), frames.end(), frame) - frames.begin());
}

// A flipped bit within a packet is not always noticed; but no image takes the number of another.
TEST_P(StrayVideo, FlippedBitsMoveNoFrame) {
  const std::vector<std::string> frames = framesOf(path_);
  const std::string whole = folder_.read("rgb.mp4");
  const size_t from = whole.find("mdat") + 4;
  for (size_t at = from; at < whole.size(); at += (whole.size() - from) / 40) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    folder_.write("rgb.mp4", damaged);
    refusal([&] {
      Video video(path_);
      for (uint32_t i = 0; i < kShotFrames; ++i)
        refusal(
            [&] { EXPECT_THAT(numberOf(bytesOf(video.read(i)), frames), AnyOf(i, kShotFrames)) << "byte " << at; });
    });
  }
}

TEST_P(StrayVideo, AListOfOtherFilesIsNone) {
  folder_.write("other.mp4", folder_.read("rgb.mp4"));
  folder_.write("rgb.mp4", "#EXTM3U\n#EXTINF:1,\nother.mp4\n");
  EXPECT_THAT(refusalOfOpen(), HasSubstr("rgb.mp4: is no MP4 file"));
  folder_.write("rgb.mp4", std::string("\0\0\0\x0C"
                                       "ftypisom",
                                       12) +
                               "#EXTM3U\n#EXTINF:1,\nother.mp4\n");
  EXPECT_THAT(refusalOfOpen(), HasSubstr("rgb.mp4: cannot be decoded"));
}

}  // namespace
}  // namespace sphc::contract

#endif
