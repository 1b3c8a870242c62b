// One map under several localizers in threads; and a camera that is unplugged while its image is looked at.
#include <gtest/gtest.h>

#include <memory>
#include <thread>
#include <vector>

#include "drivers/v4l2/open.h"
#include "tests/capi/answers.h"
#include "tests/support/fake_v4l2.h"

namespace {

using sphc::test::Answer;
using sphc::test::GuardedMemory;
using sphc::test::SceneFrame;
using sphc::test::Session;

constexpr uint32_t kLocalizers = 8, kFrames = 4;

// A localizer of its own on a map of others.
class Guest {
 public:
  Guest(const sphc_localizer_config &config, const sphc_map *map) {
    sphc_memory need = {};
    EXPECT_EQ(sphc_localizer_memory(&config, &need, nullptr), SPHC_OK);
    state_ = GuardedMemory(need.state_bytes, need.alignment);
    scratch_ = GuardedMemory(need.scratch_bytes, need.alignment);
    EXPECT_EQ(sphc_localizer_init(state_.data(), state_.size(), scratch_.data(), scratch_.size(), &config,
                                  &localizer_, nullptr),
              SPHC_OK);
    EXPECT_EQ(sphc_localizer_set_map(localizer_, 0, map), SPHC_OK);
  }
  ~Guest() {
    sphc_localizer_fini(&localizer_);
    EXPECT_TRUE(state_.guardsIntact() && scratch_.guardsIntact());
  }
  Guest(const Guest &) = delete;
  Guest &operator=(const Guest &) = delete;

  Answer answer(const sphc_localizer_frame &frame) {
    Answer answer;
    answer.status = sphc_localizer_process(localizer_, &frame, &answer.result);
    return answer;
  }

 private:
  GuardedMemory state_, scratch_;
  sphc_localizer *localizer_ = nullptr;
};

class SharedMap : public testing::Test {
 protected:
  SharedMap() {
    config_.mode = SPHC_MODE_TRACKING;
    for (uint32_t i = 0; i < kFrames; ++i) {
      frames_.push_back(sphc::test::sceneFrame(config_, i));
      frames_[i]->frame.color_time_ns = frames_[i]->frame.depth_time_ns = (i + 1) * int64_t{50000000};
    }
  }
  // In an order of its own, which begins with another frame.
  std::vector<Answer> answers(uint32_t first) {
    Guest guest(config_, session_.map());
    std::vector<Answer> answers;
    for (uint32_t i = 0; i < kFrames; ++i) {
      sphc_localizer_frame frame = frames_[(first + i) % kFrames]->frame;
      frame.color_time_ns = frame.depth_time_ns = (i + 1) * int64_t{50000000};
      answers.push_back(guest.answer(frame));
    }
    return answers;
  }

  sphc_localizer_config config_ = sphc::test::sceneConfig();
  Session session_{config_};
  std::vector<std::unique_ptr<SceneFrame>> frames_;
};

TEST_F(SharedMap, EightLocalizersInThreadsAnswerAsOneAlone) {
  std::vector<std::vector<Answer>> together(kLocalizers);
  std::vector<std::thread> threads;
  for (uint32_t i = 0; i < kLocalizers; ++i)
    threads.emplace_back([&, i] {
      sphc_map_info info = {};
      info.struct_size = sizeof info;
      EXPECT_EQ(sphc_map_get_info(session_.map(), &info), SPHC_OK);
      together[i] = answers(i);
    });
  for (std::thread &thread : threads) thread.join();
  for (uint32_t i = 0; i < kLocalizers; ++i) {
    EXPECT_EQ(together[i][0].status, SPHC_OK);
    EXPECT_TRUE(together[i] == answers(i)) << "localizer " << i;
  }
}

// The image is in a buffer of the kernel, on loan, and the camera is gone before the frame is answered.
TEST_F(SharedMap, AFrameIsAnsweredWhileItsCameraIsUnplugged) {
  const sphc_camera &size = config_.rig.color_camera;
  sphc::test::FakeKernel kernel;
  sphc::test::FakeCamera fake({{V4L2_PIX_FMT_GREY, size.width, size.height, 30}});
  const std::vector<uint8_t> gray = frames_[0]->images.gray;
  fake.paint = [gray](sphc::test::FakeFrame &frame) {
    frame.bytes_used = static_cast<uint32_t>(gray.size());
    std::copy(gray.begin(), gray.end(), frame.data);
  };
  kernel.plugIn(0, std::move(fake));
  sphc_v4l2_config config;
  sphc_v4l2_config_init(&config, sizeof config);
  config.stream = SPHC_STREAM_COLOR;
  config.width = size.width;
  config.height = size.height;
  sphc_v4l2 *camera = nullptr;
  sphc_message message = {};
  ASSERT_GE(sphc::v4l2::openCamera(kernel.syscalls(), "/dev/video0", &config, &camera, &message), 0)
      << message.text;
  sphc_source source;
  sphc_v4l2_source(camera, &source);
  ASSERT_EQ(source.start(source.self), SPHC_OK);
  sphc_capture capture = {}, next = {};
  capture.struct_size = next.struct_size = sizeof capture;
  ASSERT_EQ(source.acquire(source.self, 1000000, &capture), SPHC_OK) << source.message(source.self);

  sphc_localizer_frame frame = frames_[0]->frame;
  const Answer expected = Guest(config_, session_.map()).answer(frame);
  frame.color = capture.image;
  Answer answer;
  std::thread processing([&] { answer = Guest(config_, session_.map()).answer(frame); });
  kernel.unplug(0);
  sphc_status status = SPHC_OK;
  while (status == SPHC_OK || status == SPHC_AGAIN) {  // what was on its way
    status = source.acquire(source.self, 1000000, &next);
    if (status == SPHC_OK) source.release(source.self, &next);
  }
  EXPECT_EQ(status, SPHC_E_DEVICE_LOST);
  processing.join();
  EXPECT_EQ(answer.status, SPHC_OK);
  EXPECT_TRUE(answer == expected);
  source.release(source.self, &capture);
  source.stop(source.self);
  sphc_v4l2_close(&camera);
}

}  // namespace
