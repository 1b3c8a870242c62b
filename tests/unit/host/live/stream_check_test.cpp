#include "host/live/stream_check.h"

#include <gtest/gtest.h>

#include <vector>

namespace sphc::host {
namespace {

using Grade = Finding::Grade;
constexpr uint32_t kWidth = 64, kHeight = 48;

class StreamCheckTest : public testing::Test {
 protected:
  StreamCheckTest() {
    sphc_rig_init(&calibration_);
    calibration_.color_camera =
        calibration_.depth_camera = {SPHC_CAMERA_PINHOLE, kWidth, kHeight, 4, {50, 50, 32, 24}};
  }
  void feed(StreamCheck *check, sphc_stream stream, uint16_t value, uint32_t frames = 20, uint32_t skip = 0) {
    const bool color = stream == SPHC_STREAM_COLOR;
    std::vector<uint8_t> gray(kWidth * kHeight, static_cast<uint8_t>(value));
    std::vector<uint16_t> depth(kWidth * kHeight, value);
    uint32_t number = 0;
    for (uint32_t i = 0; i < frames; ++i) {
      sphc_capture capture = capture_;
      capture.struct_size = sizeof capture;
      capture.stream = stream;
      if (i == frames / 2) number += missing_;
      capture.sequence = number;
      capture.time_ns = period_ns_ * number + uneven_ns_ * (number % 3) + (2 * i >= frames ? pause_ns_ : 0);
      number += 1 + skip;
      if (color)
        capture.image = {gray.data(), kWidth, kHeight, kWidth, SPHC_FORMAT_GRAY8};
      else
        capture.image = {depth.data(), kWidth, kHeight, 2 * kWidth, SPHC_FORMAT_DEPTH16};
      check->look(capture);
    }
  }
  Finding found(sphc_stream stream, uint16_t value, const std::string &what, uint32_t skip = 0) {
    StreamCheck check(stream, calibration_, is_recording_);
    feed(&check, stream, value, 20, skip);
    for (const Finding &finding : check.findings())
      if (finding.what == what) return finding;
    ADD_FAILURE() << "nothing is said of " << what;
    return {Grade::kFine, "", ""};
  }

  sphc_rig calibration_;
  sphc_capture capture_ = {};
  int64_t period_ns_ = 33333333;  // from a number to the next
  int64_t pause_ns_ = 0;          // in the middle
  int64_t uneven_ns_ = 0;         // of a number's third
  uint32_t missing_ = 0;          // numbers, in the middle
  bool is_recording_ = false;
};

TEST_F(StreamCheckTest, GoodStreamsAreFine) {
  EXPECT_EQ(found(SPHC_STREAM_COLOR, 120, "colour rate").grade, Grade::kFine);
  EXPECT_NE(found(SPHC_STREAM_COLOR, 120, "colour rate").text.find("30.0 images a second"), std::string::npos);
  EXPECT_EQ(found(SPHC_STREAM_COLOR, 120, "brightness").grade, Grade::kFine);
  EXPECT_EQ(found(SPHC_STREAM_COLOR, 120, "colour clock").grade, Grade::kFine);
  EXPECT_EQ(found(SPHC_STREAM_DEPTH, 1500, "depth").grade, Grade::kFine);
}

TEST_F(StreamCheckTest, FaultsAreNamed) {
  EXPECT_EQ(found(SPHC_STREAM_COLOR, 120, "colour rate", 1).grade, Grade::kWrong) << "half never came";
  EXPECT_EQ(found(SPHC_STREAM_COLOR, 9, "brightness").grade, Grade::kDoubtful);
  EXPECT_EQ(found(SPHC_STREAM_COLOR, 250, "brightness").grade, Grade::kDoubtful);
  EXPECT_EQ(found(SPHC_STREAM_DEPTH, 0, "depth").grade, Grade::kWrong) << "blind";
  calibration_.depth_unit_m = 1;
  EXPECT_NE(found(SPHC_STREAM_DEPTH, 1500, "depth").text.find("depth_unit_m"), std::string::npos);
  calibration_.color_camera.width = 640;
  EXPECT_EQ(found(SPHC_STREAM_COLOR, 120, "colour size").grade, Grade::kWrong);
  const StreamCheck silent(SPHC_STREAM_DEPTH, calibration_, is_recording_);
  ASSERT_EQ(silent.findings().size(), 1u);
  EXPECT_EQ(silent.findings()[0].grade, Grade::kWrong);
}

// What was recorded no USB port helps.
TEST_F(StreamCheckTest, OfARecordingTheCureIsAnother) {
  is_recording_ = true;
  missing_ = 3;
  const std::string lost = found(SPHC_STREAM_COLOR, 120, "colour rate").text;
  EXPECT_EQ(lost.find("USB"), std::string::npos) << lost;
  EXPECT_NE(lost.find("copy the recording again"), std::string::npos) << lost;
  const std::string none = StreamCheck(SPHC_STREAM_DEPTH, calibration_, is_recording_).findings().at(0).text;
  EXPECT_NE(none.find("is the recording whole?"), std::string::npos) << none;
}

// Of a recording; a camera that skips every second number loses it.
TEST_F(StreamCheckTest, EveryThirdFrameIsARateAndNoLoss) {
  is_recording_ = true;
  const Finding third = found(SPHC_STREAM_COLOR, 120, "colour rate", 2);
  EXPECT_EQ(third.grade, Grade::kFine) << third.text;
  EXPECT_NE(third.text.find("10.0 images a second"), std::string::npos) << third.text;
  EXPECT_NE(third.text.find("0 of 20 never came"), std::string::npos) << third.text;
  missing_ = 9;
  const Finding gap = found(SPHC_STREAM_COLOR, 120, "colour rate", 2);
  EXPECT_EQ(gap.grade, Grade::kWrong) << gap.text;
  EXPECT_NE(gap.text.find("3 of 23 never came"), std::string::npos) << gap.text;
}

TEST_F(StreamCheckTest, WhatCannotBeReadIsNoLoss) {
  is_recording_ = true;
  missing_ = 2;
  StreamCheck check(SPHC_STREAM_COLOR, calibration_, is_recording_);
  std::vector<int64_t> times_ns;
  for (int64_t number = 0; number < 22; ++number) times_ns.push_back(period_ns_ * number);
  check.expect(times_ns);
  feed(&check, SPHC_STREAM_COLOR, 120);
  EXPECT_NE(check.findings()[0].text.find("0 of 22 never came, and 2 cannot be read"), std::string::npos)
      << check.findings()[0].text;
}

TEST_F(StreamCheckTest, TimesInAnotherUnitAreNamed) {
  is_recording_ = true;
  const auto expectNamed = [&](int64_t period_ns, const char *unit) {
    period_ns_ = period_ns;
    const Finding slow = found(SPHC_STREAM_COLOR, 120, "colour rate");
    EXPECT_EQ(slow.grade, Grade::kWrong);
    EXPECT_NE(slow.text.find(unit), std::string::npos) << slow.text;
  };
  expectNamed(33300000000, "in milliseconds? Seconds are expected; divide the times of images and poses by 1000");
  expectNamed(33300000000000, "in microseconds?");
  expectNamed(33300000000000000, "in nanoseconds?");
}

TEST_F(StreamCheckTest, StillsAreNotInMilliseconds) {
  is_recording_ = true;
  for (const int64_t period_ns : {int64_t{2000000000}, int64_t{10000000000}}) {
    period_ns_ = period_ns;
    EXPECT_EQ(found(SPHC_STREAM_COLOR, 120, "colour rate").grade, Grade::kFine) << period_ns;
  }
  period_ns_ = 12000000000;
  StreamCheck few(SPHC_STREAM_COLOR, calibration_, true);
  feed(&few, SPHC_STREAM_COLOR, 120, 8);
  EXPECT_EQ(few.findings().at(0).grade, Grade::kFine) << few.findings().at(0).text;
  uneven_ns_ = 5000000000;  // by hand
  EXPECT_EQ(found(SPHC_STREAM_COLOR, 120, "colour rate").grade, Grade::kFine);
}

TEST_F(StreamCheckTest, APauseIsNoRate) {
  pause_ns_ = 2000000000;
  EXPECT_EQ(found(SPHC_STREAM_COLOR, 120, "colour rate").grade, Grade::kDoubtful);
  EXPECT_NE(found(SPHC_STREAM_COLOR, 120, "colour rate").text.find("longest pause 2033 ms"), std::string::npos);
  pause_ns_ = 100000000;  // of a machine that was busy
  EXPECT_EQ(found(SPHC_STREAM_COLOR, 120, "colour rate").grade, Grade::kFine);
}

TEST_F(StreamCheckTest, TheSameImageOverAgainIsNamed) {
  EXPECT_EQ(found(SPHC_STREAM_DEPTH, 1500, "depth images").grade, Grade::kWrong);
  StreamCheck check(SPHC_STREAM_DEPTH, calibration_, is_recording_);
  for (uint16_t i = 0; i < 20; ++i) feed(&check, SPHC_STREAM_DEPTH, static_cast<uint16_t>(1500 + i), 1);
  for (const Finding &finding : check.findings()) EXPECT_NE(finding.what, "depth images");
}

TEST_F(StreamCheckTest, TimesThatAreNotTheMiddle) {
  capture_.time_point = SPHC_TIME_START;
  EXPECT_EQ(found(SPHC_STREAM_COLOR, 120, "colour clock").grade, Grade::kDoubtful);
  capture_.exposure_us = 8000;
  EXPECT_EQ(found(SPHC_STREAM_COLOR, 120, "colour clock").grade, Grade::kFine);
}

TEST(PairsFinding, TellsTheOffsetAndItsSpread) {
  EXPECT_EQ(pairsFinding({}, {9, 0, 9}).grade, Grade::kWrong);
  const Finding steady = pairsFinding({-4, -4.1, -3.9, -4}, {5, 4, 1});
  EXPECT_EQ(steady.grade, Grade::kFine);
  EXPECT_NE(steady.text.find("4.0 ms before"), std::string::npos) << steady.text;
  EXPECT_EQ(pairsFinding({-15, 0, 15, 8}, {4, 4, 0}).grade, Grade::kDoubtful);
  const Finding apart = pairsFinding({33, 33.1, 32.9, 33}, {4, 4, 0});
  EXPECT_EQ(apart.grade, Grade::kDoubtful);
  EXPECT_NE(apart.text.find("odometry"), std::string::npos) << apart.text;
}

TEST(PairsFinding, ManyImagesWithoutAPartnerAreDoubtful) {
  const std::vector<double> steady(60, -4);
  const Finding many = pairsFinding(steady, {80, 80, 40});
  EXPECT_EQ(many.grade, Grade::kDoubtful);
  EXPECT_NE(many.text.find("40 images had no partner, so 25 % of the rarer stream's images"), std::string::npos)
      << many.text;
  EXPECT_EQ(pairsFinding(steady, {62, 62, 4}).grade, Grade::kFine) << "two pairs are missing";
  EXPECT_EQ(pairsFinding(steady, {360, 60, 300}).grade, Grade::kFine) << "a camera of six times the rate";
  EXPECT_EQ(pairsFinding(steady, {68, 62, 0}).grade, Grade::kFine) << "they wait still";
}

}  // namespace
}  // namespace sphc::host
