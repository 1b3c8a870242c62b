#include "host/live/rig.h"

#include <gtest/gtest.h>

#include <iterator>
#include <stdexcept>

#include "tests/contract/tiny_recording.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

constexpr uint32_t kRecordedFrames = 6;

class RigTest : public testing::Test {
 protected:
  void SetUp() override {
    const std::string walk = folder_ / "walk";
    contract::writeTinyRecording(walk, kRecordedFrames);
    options_.both = "replay:" + walk;
  }
  std::unique_ptr<Rig> open() {
    return std::make_unique<Rig>(options_, [this](const std::string &trouble) { troubles_ += trouble + "\n"; });
  }

  test::TempFolder folder_;
  RigOptions options_;
  std::string troubles_;
};

TEST_F(RigTest, GivesEveryPairOfARecordingAndThenItsEnd) {
  const auto rig = open();
  EXPECT_TRUE(rig->waits());
  sphc_rig calibration = {};
  ASSERT_TRUE(rig->calibration(&calibration));
  EXPECT_EQ(calibration.color_camera.width, contract::kColorWidth);
  uint32_t captures = 0, pairs = 0;
  rig->watch([&](const sphc_capture &) { ++captures; });
  CapturePair pair;
  Rig::Got got;
  while ((got = rig->next(std::chrono::seconds(10), &pair)) == Rig::Got::kPair) {
    EXPECT_EQ(pair.color.sequence, pairs);
    EXPECT_EQ(pair.depth.sequence, pairs);
    EXPECT_EQ(pair.depth.time_ns - pair.color.time_ns, contract::kDepthLagNs);
    ++pairs;
    rig->release(pair);
  }
  EXPECT_EQ(got, Rig::Got::kEnd);
  EXPECT_EQ(pairs, kRecordedFrames);
  EXPECT_EQ(captures, 2 * kRecordedFrames);
  EXPECT_EQ(rig->counts().pairs, kRecordedFrames);
  EXPECT_EQ(rig->next(std::chrono::milliseconds(0), &pair), Rig::Got::kEnd);
  EXPECT_EQ(troubles_, "");
}

TEST_F(RigTest, WhatIsTooFarApartIsNoPair) {
  options_.tolerance_ms = 0.5;  // depth lags by a millisecond
  const auto rig = open();
  CapturePair pair;
  EXPECT_EQ(rig->next(std::chrono::seconds(10), &pair), Rig::Got::kEnd);
  const sphc_pairer_counts counts = rig->counts();
  EXPECT_EQ(counts.pairs, 0u);
  EXPECT_EQ(counts.too_far + counts.overtaken + counts.full + counts.ended, 2 * kRecordedFrames);
}

TEST_F(RigTest, ARecordingIsThereFrameByFrameToo) {
  const auto rig = open();
  CapturePair pair;
  ASSERT_EQ(rig->next(std::chrono::seconds(10), &pair), Rig::Got::kPair);
  ASSERT_NE(rig->replayed(), nullptr);
  EXPECT_EQ(rig->replayed()->frameCount(), kRecordedFrames);
  EXPECT_EQ(rig->replayed()->read(1).color_time_ns, contract::kFirstNs + contract::kPeriodNs);
  rig->release(pair);
  EXPECT_EQ(rig->next(std::chrono::seconds(10), &pair), Rig::Got::kPair) << "the source is not disturbed";
  EXPECT_EQ(pair.color.sequence, 1u);
  rig->release(pair);
  options_.tolerance_ms = 0.5;
  EXPECT_EQ(open()->replayed()->frameCount(), 0u) << "pairs are those of the rig";
}

// Read at once, a recording without pairs comes to its end in steps that the caller sees.
TEST_F(RigTest, ManyCapturesWithoutAPairAreNothing) {
  const std::string walk = folder_ / "long";
  contract::writeTinyRecording(walk, 150);
  options_.both = "replay:" + walk;
  options_.tolerance_ms = 0.5;
  options_.wish.at_once = true;
  const auto rig = open();
  uint32_t captures = 0;
  rig->watch([&](const sphc_capture &) { ++captures; });
  CapturePair pair;
  EXPECT_EQ(rig->next(std::chrono::milliseconds(0), &pair), Rig::Got::kNothing);
  EXPECT_EQ(captures, 200u);
  EXPECT_EQ(rig->next(std::chrono::seconds(10), &pair), Rig::Got::kEnd);
  EXPECT_EQ(captures, 300u);
}

// A camera that is unplugged at its first frame, and then a recording in its place.
class LostDevice : public Device {
 public:
  LostDevice() {
    source_.struct_size = sizeof source_;
    source_.self = this;
    source_.start = [](void *) -> sphc_status { return SPHC_OK; };
    source_.acquire = [](void *, uint32_t, sphc_capture *) -> sphc_status { return SPHC_E_DEVICE_LOST; };
    source_.release = [](void *, const sphc_capture *) {};
    source_.stop = [](void *) {};
    source_.message = [](const void *) -> const char * { return "the camera was unplugged"; };
  }
  std::string describe() const override { return "a camera"; }
};

TEST_F(RigTest, SaysWhyALostCameraIsNotBackAndGoesOnOnceItIs) {
  const char *const kInstead[] = {"no such device", "no such device", "busy: another program has it"};
  uint32_t tries = 0;
  options_.open = [&](const std::string &spec, const Wish &wish) -> std::unique_ptr<Device> {
    const uint32_t earlier = tries++;
    if (earlier == 0) return std::make_unique<LostDevice>();
    if (earlier <= std::size(kInstead)) throw std::runtime_error(spec + ": " + kInstead[earlier - 1]);
    return openDevice(spec, wish);
  };
  const auto rig = open();
  CapturePair pair;
  ASSERT_EQ(rig->next(std::chrono::milliseconds(100), &pair), Rig::Got::kNothing);
  EXPECT_EQ(rig->losses(), 1u);
  EXPECT_EQ(rig->troubles(), options_.both + ": unplugged");
  while (tries <= std::size(kInstead))
    ASSERT_EQ(rig->next(std::chrono::milliseconds(100), &pair), Rig::Got::kNothing);
  EXPECT_EQ(rig->troubles(), options_.both + ": not back yet: " + options_.both + ": busy: another program has it");
  ASSERT_EQ(rig->next(std::chrono::seconds(10), &pair), Rig::Got::kPair);
  rig->release(pair);
  EXPECT_EQ(rig->troubles(), "");
  EXPECT_EQ(troubles_, options_.both + ": the camera was unplugged; waiting for it to come back\n" +
                           "not back yet: " + options_.both + ": no such device\n" + "not back yet: " +
                           options_.both + ": busy: another program has it\n" + options_.both + ": is back\n");
}

TEST_F(RigTest, WhatCannotBeReadIsHeardApartFromWhatTheCameraDoes) {
  class BrokenDevice : public LostDevice {
   public:
    BrokenDevice() {
      source_.acquire = [](void *, uint32_t, sphc_capture *) -> sphc_status { return SPHC_E_IMAGE; };
      source_.message = [](const void *) -> const char * { return "an image was cut off"; };
    }
  };
  options_.open = [](const std::string &, const Wish &) { return std::make_unique<BrokenDevice>(); };
  const auto rig = open();
  uint32_t unreadable = 0;
  rig->hearUnreadable([&](const std::string &why) {
    EXPECT_EQ(why, options_.both + ": an image was cut off");
    ++unreadable;
  });
  CapturePair pair;
  while (rig->losses() == 0) ASSERT_EQ(rig->next(std::chrono::milliseconds(1), &pair), Rig::Got::kNothing);
  EXPECT_GT(unreadable, 10u);
  EXPECT_EQ(troubles_, options_.both + ": an image was cut off; waiting for it to come back\n");
}

// Two cameras, each with a clock of its own: both come out on the host's.
TEST_F(RigTest, TwoCamerasShareTheClockOfTheHost) {
  options_.color = options_.depth = options_.both;
  options_.both.clear();
  options_.tolerance_ms = 1000;
  const auto rig = open();
  uint32_t captures = 0;
  rig->watch([&](const sphc_capture &capture) {
    EXPECT_EQ(capture.clock, SPHC_CLOCK_MONOTONIC);
    EXPECT_LT(capture.time_ns, contract::kFirstNs);  // the recording's own times are of the year 2011
    ++captures;
  });
  CapturePair pair;
  uint32_t pairs = 0;
  while (rig->next(std::chrono::seconds(10), &pair) == Rig::Got::kPair) {
    rig->release(pair);
    ++pairs;
  }
  EXPECT_EQ(captures, 2 * kRecordedFrames);
  EXPECT_GT(pairs, 0u);
}

// What a camera sends while another one is being opened is lost.
TEST_F(RigTest, NoCameraStartsBeforeAllAreOpen) {
  options_.color = "color";
  options_.depth = "depth";
  options_.both.clear();
  std::string order;
  struct StartTold : LostDevice {
    explicit StartTold(std::string *order) : order_(order) {
      source_.self = this;
      source_.start = [](void *self) -> sphc_status {
        *static_cast<StartTold *>(self)->order_ += "start ";
        return SPHC_OK;
      };
    }
    std::string *order_;
  };
  options_.open = [&](const std::string &spec, const Wish &) {
    order += spec + " ";
    return std::make_unique<StartTold>(&order);
  };
  open();
  EXPECT_EQ(order, "color depth start start ");
}

// How the clocks of two lie to each other is told by when their images arrive.
TEST_F(RigTest, OneRecordingAloneIsReadAtOnce) {
  std::vector<bool> at_once;
  options_.open = [&](const std::string &, const Wish &wish) {
    at_once.push_back(wish.at_once);
    return std::make_unique<LostDevice>();
  };
  options_.wish.at_once = true;
  open();
  EXPECT_EQ(at_once, std::vector<bool>({true}));
  options_.color = options_.depth = options_.both;
  options_.both.clear();
  open();
  EXPECT_EQ(at_once, std::vector<bool>({true, false, false}));
}

// A camera of one stream on a clock of its own, whose frames take as long as each other to arrive.
class SteadyDevice : public LostDevice {
 public:
  SteadyDevice(sphc_stream stream, uint32_t time_sigma_us) : stream_(stream), time_sigma_us_(time_sigma_us) {
    source_.self = this;
    source_.acquire = [](void *self, uint32_t, sphc_capture *capture) {
      return static_cast<SteadyDevice *>(self)->acquire(capture);
    };
  }

 private:
  sphc_status acquire(sphc_capture *capture) {
    if (sequence_ == kRecordedFrames) return SPHC_END;
    capture->stream = stream_;
    capture->sequence = sequence_++;
    capture->token = sequence_;
    capture->time_ns = sequence_ * contract::kPeriodNs;
    capture->arrival_ns = capture->time_ns + 5000000000;
    capture->time_sigma_us = time_sigma_us_;
    return SPHC_OK;
  }

  const sphc_stream stream_;
  const uint32_t time_sigma_us_;
  uint32_t sequence_ = 0;
};

// The host's clock adds what the mapping to it does not know: a millisecond of the least delay, by default.
TEST_F(RigTest, TwoCamerasAreAsUnsureAsTheirTimesAndTheMappingTogether) {
  options_.color = "color";
  options_.depth = "depth";
  options_.both.clear();
  options_.open = [](const std::string &, const Wish &wish) {
    return wish.color ? std::make_unique<SteadyDevice>(SPHC_STREAM_COLOR, 3000)
                      : std::make_unique<SteadyDevice>(SPHC_STREAM_DEPTH, UINT32_MAX);
  };
  const auto rig = open();
  uint32_t captures = 0;
  rig->watch([&](const sphc_capture &capture) {
    EXPECT_EQ(capture.time_sigma_us, capture.stream == SPHC_STREAM_COLOR ? 3162u : UINT32_MAX);
    ++captures;
  });
  CapturePair pair;
  while (rig->next(std::chrono::seconds(10), &pair) == Rig::Got::kPair) rig->release(pair);
  EXPECT_EQ(captures, 2 * kRecordedFrames);
}

// Colour and depth of two sizes need no options.
TEST_F(RigTest, EachCameraIsAskedForTheSizeOfItsCalibration) {
  options_.wish.calibration = folder_ / "walk/calibration.json";
  options_.color = "color";
  options_.depth = "depth";
  options_.both.clear();
  std::vector<uint32_t> sizes;
  options_.open = [&](const std::string &, const Wish &wish) {
    sizes.insert(sizes.end(), {wish.width, wish.height});
    return std::make_unique<LostDevice>();
  };
  open();
  EXPECT_EQ(sizes, (std::vector<uint32_t>{contract::kColorWidth, contract::kColorHeight, contract::kDepthWidth,
                                          contract::kDepthHeight}));
  sizes.clear();
  options_.wish.width = 1280;
  options_.wish.height = 960;
  open();
  EXPECT_EQ(sizes, (std::vector<uint32_t>{1280, 960, 1280, 960})) << "as was said";
  sizes.clear();
  options_.wish = {};
  open();
  EXPECT_EQ(sizes, (std::vector<uint32_t>{640, 480, 640, 480})) << "nobody knows";
}

TEST_F(RigTest, SaysWhatCannotBeOpenedAndTheCure) {
  const Wish both, color = [] {
    Wish wish;
    wish.depth = false;
    return wish;
  }();
  const auto says = [](const std::string &spec, const Wish &wish) {
    return test::refusal([&] { openDevice(spec, wish); });
  };
  EXPECT_NE(says("webcam:0", both).find("v4l2:, libcamera:"), std::string::npos);
  EXPECT_NE(says(std::string(300, 'x'), both).find("no such kind of camera"), std::string::npos);
  EXPECT_NE(says(folder_ / "walk", both).find("say replay:"), std::string::npos);
  EXPECT_NE(says("v4l2:/dev/video0", both).find("--color and --depth"), std::string::npos);
  EXPECT_NE(says("v4l2:/dev/no-such-camera", color).find("/dev/no-such-camera"), std::string::npos);
  EXPECT_NE(says("libcamera:", both).find("--depth v4l2:"), std::string::npos);
  EXPECT_NE(says("simulated:", color).find("--device simulated:"), std::string::npos);
  EXPECT_NE(says("simulated:foot", both).find("feet,people"), std::string::npos);
  EXPECT_NE(says("simulated:feet,room=3", both).find("room is unknown; there are seed="), std::string::npos);
  EXPECT_EQ(says("simulated:tiles,carpet", both).find("simulated:tiles,carpet: simulated: with has"), 0u);
  EXPECT_NE(says("simulated:cameras=watch", both).find("there are headset, phone"), std::string::npos);
  EXPECT_NE(says("simulated:seed=x", both).find("seed=7"), std::string::npos);
  EXPECT_NE(says("replay:/no/such/walk", both).find("/no/such/walk"), std::string::npos);
}

}  // namespace
}  // namespace sphc::host
