// The two halves of a frame: extract, locate, and features that come from elsewhere.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <thread>
#include <vector>

#include "spherecloud/spherecloud.hpp"
#include "tests/capi/answers.h"
#include "tests/capi/bytes.h"
#include "tests/support/session.h"
#include "tests/support/stepping_clock.h"

namespace {

using sphc::test::Answer;
using sphc::test::answerOf;
using sphc::test::expectMentions;
using sphc::test::GuardedMemory;
using sphc::test::Output;
using sphc::test::SceneFrame;
using sphc::test::Session;

constexpr uint32_t kFrames = 7;

struct Features {
  explicit Features(const sphc_localizer_config &config) {
    sphc_memory need = {};
    EXPECT_EQ(sphc_features_memory(&config, &need, nullptr), SPHC_OK);
    EXPECT_EQ(need.scratch_bytes, 0u);
    memory = GuardedMemory(need.state_bytes, need.alignment);
    EXPECT_EQ(sphc_features_init(memory.data(), memory.size(), &config, &handle, nullptr), SPHC_OK);
  }
  ~Features() {
    sphc_features_fini(&handle);
    EXPECT_EQ(handle, nullptr);
    EXPECT_TRUE(memory.guardsIntact());
  }
  Features(const Features &) = delete;
  Features &operator=(const Features &) = delete;

  sphc_features_arrays arrays() const {
    sphc_features_arrays arrays = {};
    arrays.struct_size = sizeof arrays;
    EXPECT_EQ(sphc_features_get(handle, &arrays), SPHC_OK);
    return arrays;
  }

  GuardedMemory memory;
  sphc_features *handle = nullptr;
};

class Halves : public testing::Test {
 protected:
  // A walk, in which one frame shows nothing and one comes from another room.
  Halves() {
    config_.mode = SPHC_MODE_TRACKING;
    for (uint32_t i = 0; i < kFrames; ++i) {
      frames_.push_back(sphc::test::sceneFrame(config_, i % 4, i == 4));
      frames_[i]->frame.color_time_ns = frames_[i]->frame.depth_time_ns = (i + 1) * int64_t{50000000};
    }
    for (uint8_t &pixel : frames_[2]->images.gray) pixel = 90;
  }
  const sphc_localizer_frame &frame(uint32_t i) const { return frames_[i]->frame; }

  Answer processed(Session *session, const sphc_localizer_frame &frame) const {
    return answerOf(session, [&](sphc_localizer *localizer, sphc_localizer_result *result) {
      return sphc_localizer_process(localizer, &frame, result);
    });
  }
  Answer located(Session *session, const sphc_localizer_frame &frame, const Features &features) const {
    return answerOf(session, [&](sphc_localizer *localizer, sphc_localizer_result *result) {
      return sphc_localizer_locate(localizer, &frame, features.handle, result);
    });
  }
  std::vector<Answer> allProcessed() const {
    Session session(config_, 0.5, 2);
    std::vector<Answer> answers;
    for (uint32_t i = 0; i < kFrames; ++i) answers.push_back(processed(&session, frame(i)));
    return answers;
  }
  void expectSetRefused(const sphc_features_arrays &arrays, sphc_status expected, const char *words) {
    EXPECT_EQ(sphc_features_set(features_.handle, &frame(0), &arrays), expected) << words;
    expectMentions(sphc_features_message(features_.handle), words);
  }

  sphc_localizer_config config_ = sphc::test::sceneConfig();
  std::vector<std::unique_ptr<SceneFrame>> frames_;
  Features features_{config_};
};

TEST_F(Halves, SameBytesAsProcess) {
  const std::vector<Answer> whole = allProcessed();
  EXPECT_EQ(whole[1].status, SPHC_OK);
  EXPECT_EQ(whole[2].result.outcome, SPHC_OUTCOME_FEW_KEYPOINTS);
  EXPECT_EQ(whole[4].result.map_id, 1u);
  Session session(config_, 0.5, 2);
  for (uint32_t i = 0; i < kFrames; ++i) {
    ASSERT_EQ(sphc_localizer_extract(session.localizer(), &frame(i), features_.handle), SPHC_OK);
    EXPECT_TRUE(located(&session, frame(i), features_) == whole[i]) << i;
  }
}

TEST_F(Halves, TurnsWithProcess) {
  const std::vector<Answer> whole = allProcessed();
  Session session(config_, 0.5, 2);
  for (uint32_t i = 0; i < kFrames; ++i) {
    const bool at_once = i % 2;
    if (!at_once) {
      ASSERT_EQ(sphc_localizer_extract(session.localizer(), &frame(i), features_.handle), SPHC_OK);
    }
    EXPECT_TRUE((at_once ? processed(&session, frame(i)) : located(&session, frame(i), features_)) == whole[i])
        << i;
  }
}

TEST_F(Halves, OneThreadLocatesWhileAnotherExtracts) {
  const std::vector<Answer> whole = allProcessed();
  Session session(config_, 0.5, 2);
  Features second(config_);
  Features *const of[] = {&features_, &second};
  ASSERT_EQ(sphc_localizer_extract(session.localizer(), &frame(0), of[0]->handle), SPHC_OK);
  for (uint32_t i = 0; i < kFrames; ++i) {
    sphc_status next = SPHC_OK;
    std::thread extracting([&] {
      if (i + 1 < kFrames)
        next = sphc_localizer_extract(session.localizer(), &frame(i + 1), of[(i + 1) % 2]->handle);
    });
    const Answer answer = located(&session, frame(i), *of[i % 2]);
    session.setParameter(SPHC_PARAMETER_MIN_INLIERS, 10);
    sphc_localizer_prediction prediction = {};
    prediction.struct_size = sizeof prediction;
    sphc_localizer_predict(session.localizer(), frame(i).color_time_ns, &prediction);
    extracting.join();
    EXPECT_EQ(next, SPHC_OK);
    EXPECT_TRUE(answer == whole[i]) << i;
  }
}

TEST_F(Halves, SeveralLocalizersLocateTheSameFeatures) {
  Session first(config_), second(config_);
  ASSERT_EQ(sphc_localizer_extract(first.localizer(), &frame(1), features_.handle), SPHC_OK);
  const std::vector<uint8_t> before = features_.memory.copy();
  Answer of_second = {};
  std::thread other([&] { of_second = located(&second, frame(1), features_); });
  const Answer of_first = located(&first, frame(1), features_);
  other.join();
  EXPECT_EQ(of_first.status, SPHC_OK);
  EXPECT_TRUE(of_first == of_second);
  EXPECT_EQ(features_.memory.copy(), before);
}

// What is looked at after the features is a copy: here the hints of a frame that shows nothing.
TEST_F(Halves, TheImageMayGo) {
  Session whole(config_), halves(config_);
  const Answer expected = processed(&whole, frame(2));
  EXPECT_TRUE(expected.result.hints & SPHC_HINT_TOO_PLAIN);
  const sphc_image &color = frame(2).color;
  const uint32_t stride = color.width + 24;
  std::vector<uint8_t> padded(size_t{stride} * color.height, 0xAA);
  for (uint32_t y = 0; y < color.height; ++y)
    std::memcpy(&padded[size_t{y} * stride], static_cast<const uint8_t *>(color.data) + size_t{y} * color.width,
                color.width);
  sphc_localizer_frame own = frame(2);
  own.color.data = padded.data(), own.color.stride_bytes = stride;
  ASSERT_EQ(sphc_localizer_extract(halves.localizer(), &own, features_.handle), SPHC_OK);
  std::memset(padded.data(), 0, padded.size());
  own.color = {};
  EXPECT_TRUE(located(&halves, own, features_) == expected);
}

TEST_F(Halves, FeaturesFromElsewhere) {
  const std::vector<Answer> whole = allProcessed();
  Session session(config_, 0.5, 2);
  Features copy(config_);
  struct Record {
    sphc_keypoint keypoint;
    float more;
    uint8_t descriptor[SPHC_DESCRIPTOR_BYTES];
  };
  for (uint32_t i = 0; i < kFrames; ++i) {
    ASSERT_EQ(sphc_localizer_extract(session.localizer(), &frame(i), features_.handle), SPHC_OK);
    sphc_features_arrays arrays = features_.arrays();
    EXPECT_EQ(arrays.extractor, sphc_extractor_id());
    std::vector<Record> records(arrays.count);
    for (uint32_t k = 0; k < arrays.count; ++k) {
      records[k].keypoint = arrays.keypoints[k];
      std::memcpy(records[k].descriptor, arrays.descriptors + size_t{k} * arrays.descriptor_stride_bytes,
                  SPHC_DESCRIPTOR_BYTES);
    }
    arrays.keypoint_stride_bytes = arrays.descriptor_stride_bytes = sizeof(Record);
    arrays.keypoints = records.empty() ? nullptr : &records[0].keypoint;
    arrays.descriptors = records.empty() ? nullptr : records[0].descriptor;
    ASSERT_EQ(sphc_features_set(copy.handle, &frame(i), &arrays), SPHC_OK) << sphc_features_message(copy.handle);
    EXPECT_TRUE(located(&session, frame(i), copy) == whole[i]) << i;
  }
}

TEST_F(Halves, TheirObservationsAreWhatWasPutIn) {
  Session session(config_);
  ASSERT_EQ(sphc_localizer_extract(session.localizer(), &frame(0), features_.handle), SPHC_OK);
  const sphc_features_arrays arrays = features_.arrays();
  const Answer answer = located(&session, frame(0), features_);
  ASSERT_EQ(answer.observations.size(), arrays.count);
  ASSERT_GT(arrays.count, 100u);
  for (uint32_t k = 0; k < arrays.count; ++k) {
    EXPECT_EQ(answer.observations[k].x_px, arrays.keypoints[k].x_px);
    EXPECT_EQ(answer.observations[k].y_px, arrays.keypoints[k].y_px);
  }
}

TEST_F(Halves, BadKeypointsAreRefused) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
  const sphc_keypoint good[3] = {{10, 20, 2, 1, 0.5f}, {319, 239, 3, -3, 0.25f}, {0, 0, 1, 0, 0.25f}};
  const uint8_t descriptors[3][SPHC_DESCRIPTOR_BYTES] = {};
  sphc_keypoint keypoints[3];
  const sphc_features_arrays arrays = {
      sizeof arrays, sphc_extractor_id(), 3,      sizeof(sphc_keypoint), SPHC_DESCRIPTOR_BYTES, 0,
      keypoints,     descriptors[0],      nullptr};
  std::memcpy(keypoints, good, sizeof good);
  ASSERT_EQ(sphc_features_set(features_.handle, &frame(0), &arrays), SPHC_OK);
  EXPECT_STREQ(sphc_features_message(features_.handle), "");
  const struct {
    float sphc_keypoint::*field;
    float value;
    const char *words;
  } spoiled[] = {{&sphc_keypoint::x_px, kNan, "keypoint 1 lies outside"},
                 {&sphc_keypoint::x_px, -0.5f, "keypoint 1 lies outside"},
                 {&sphc_keypoint::x_px, 320.5f, "keypoint 1 lies outside"},
                 {&sphc_keypoint::y_px, 240.5f, "keypoint 1 lies outside"},
                 {&sphc_keypoint::y_px, -kInf, "keypoint 1 lies outside"},
                 {&sphc_keypoint::scale_px, 0, "keypoint 1 has a scale_px"},
                 {&sphc_keypoint::scale_px, kNan, "keypoint 1 has a scale_px"},
                 {&sphc_keypoint::scale_px, kInf, "keypoint 1 has a scale_px"},
                 {&sphc_keypoint::angle_rad, kNan, "keypoint 1 has an angle_rad"},
                 {&sphc_keypoint::angle_rad, 90, "radians"},
                 {&sphc_keypoint::response, kNan, "keypoint 1 has a response"},
                 {&sphc_keypoint::response, 1.5f, "keypoint 1 has a response"},
                 {&sphc_keypoint::response, 0.75f, "keypoint 1 is stronger"}};
  for (const auto &fault : spoiled) {
    std::memcpy(keypoints, good, sizeof good);
    keypoints[1].*fault.field = fault.value;
    expectSetRefused(arrays, SPHC_E_ARGUMENT, fault.words);
  }
  EXPECT_EQ(std::memcmp(features_.arrays().keypoints, good, sizeof good), 0);  // those of before
}

TEST_F(Halves, BadArraysAreRefused) {
  std::vector<sphc_keypoint> keypoints(config_.max_keypoints + 1, sphc_keypoint{10, 20, 2, 1, 0.5f});
  std::vector<uint8_t> descriptors(keypoints.size() * SPHC_DESCRIPTOR_BYTES);
  const sphc_features_arrays good = {sizeof good,           sphc_extractor_id(),   config_.max_keypoints,
                                     sizeof(sphc_keypoint), SPHC_DESCRIPTOR_BYTES, 0,
                                     keypoints.data(),      descriptors.data(),    nullptr};
  ASSERT_EQ(sphc_features_set(features_.handle, &frame(0), &good), SPHC_OK);
  const struct {
    void (*spoil)(sphc_features_arrays *);
    sphc_status expected;
    const char *words;
  } spoiled[] = {
      {[](sphc_features_arrays *a) { a->struct_size = 8; }, SPHC_E_STRUCT_SIZE, "sizeof(sphc_features_arrays)"},
      {[](sphc_features_arrays *a) { ++a->extractor; }, SPHC_E_MAP_EXTRACTOR, "arrays.extractor is"},
      {[](sphc_features_arrays *a) { ++a->count; }, SPHC_E_CAPACITY, "config.max_keypoints is"},
      {[](sphc_features_arrays *a) { a->keypoint_stride_bytes = 16; }, SPHC_E_ARGUMENT, "strides of 16"},
      {[](sphc_features_arrays *a) { a->keypoint_stride_bytes = 22; }, SPHC_E_ARGUMENT, "strides of 22"},
      {[](sphc_features_arrays *a) { a->keypoint_stride_bytes = SPHC_STRIDE_MAX_BYTES + 4; }, SPHC_E_ARGUMENT,
       "strides of 1048580"},
      {[](sphc_features_arrays *a) { a->descriptor_stride_bytes = SPHC_STRIDE_MAX_BYTES + 1; }, SPHC_E_ARGUMENT,
       "1048577 bytes"},
      {[](sphc_features_arrays *a) { a->descriptor_stride_bytes = 127; }, SPHC_E_ARGUMENT, "127 bytes"},
      {[](sphc_features_arrays *a) { a->keypoints = nullptr; }, SPHC_E_ARGUMENT, "arrays.keypoints is null"},
      {[](sphc_features_arrays *a) { a->descriptors = nullptr; }, SPHC_E_ARGUMENT, "arrays.descriptors is null"}};
  for (const auto &fault : spoiled) {
    sphc_features_arrays arrays = good;
    fault.spoil(&arrays);
    expectSetRefused(arrays, fault.expected, fault.words);
  }
  EXPECT_EQ(sphc_features_set(features_.handle, &frame(0), nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_features_set(features_.handle, nullptr, &good), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_features_set(nullptr, &frame(0), &good), SPHC_E_ARGUMENT);
  sphc_localizer_frame narrow = frame(0);
  narrow.color.width = 16;
  EXPECT_EQ(sphc_features_set(features_.handle, &narrow, &good), SPHC_E_IMAGE);
  expectMentions(sphc_features_message(features_.handle), "color image is 16 x");
  EXPECT_EQ(features_.arrays().count, config_.max_keypoints);
}

TEST_F(Halves, BadExtractionsAreRefused) {
  Session session(config_);
  EXPECT_EQ(sphc_localizer_extract(nullptr, &frame(0), features_.handle), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_localizer_extract(session.localizer(), &frame(0), nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_localizer_extract(session.localizer(), nullptr, features_.handle), SPHC_E_ARGUMENT);
  expectMentions(sphc_features_message(features_.handle), "frame is null");
  sphc_localizer_frame late = frame(0);
  late.deadline_us = 100;
  EXPECT_EQ(sphc_localizer_extract(session.localizer(), &late, features_.handle), SPHC_E_ARGUMENT);
  expectMentions(sphc_features_message(features_.handle), "config.clock is null");
  sphc_localizer_frame blind = frame(0);
  blind.color.data = nullptr;
  EXPECT_EQ(sphc_localizer_extract(session.localizer(), &blind, features_.handle), SPHC_E_IMAGE);
  sphc_features_arrays arrays = {};
  arrays.struct_size = sizeof arrays;
  EXPECT_EQ(sphc_features_get(features_.handle, &arrays), SPHC_E_STATE);
  EXPECT_EQ(sphc_features_get(nullptr, &arrays), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_features_get(features_.handle, nullptr), SPHC_E_ARGUMENT);
  sphc_localizer_config other = config_;
  other.max_keypoints += 1;
  Features larger(other);
  EXPECT_EQ(sphc_localizer_extract(session.localizer(), &frame(0), larger.handle), SPHC_E_ARGUMENT);
  expectMentions(sphc_features_message(larger.handle), "make both with one config");
  // A failure there says nothing of the localizer.
  EXPECT_STREQ(sphc_localizer_message(session.localizer()), "");
}

TEST_F(Halves, OtherFeaturesAreNotLocated) {
  Session session(config_);
  const auto expectRefused = [&](const sphc_features *features, const sphc_localizer_frame &frame,
                                 sphc_status expected, const char *words) {
    Output<sphc_localizer_result> result;
    result->struct_size = sizeof(sphc_localizer_result);
    EXPECT_EQ(sphc_localizer_locate(session.localizer(), &frame, features, result.get()), expected) << words;
    expectMentions(sphc_localizer_message(session.localizer()), words);
    result->struct_size = 0x5A5A5A5A;
    EXPECT_TRUE(result.untouched());
  };
  expectRefused(nullptr, frame(0), SPHC_E_ARGUMENT, "features is null");
  expectRefused(features_.handle, frame(0), SPHC_E_STATE, "of no frame yet");
  ASSERT_EQ(sphc_localizer_extract(session.localizer(), &frame(0), features_.handle), SPHC_OK);
  expectRefused(features_.handle, frame(1), SPHC_E_ARGUMENT, "features of its own image");
  sphc_localizer_frame blind = frame(0);
  blind.depth.data = nullptr;
  expectRefused(features_.handle, blind, SPHC_E_IMAGE, "depth image's data pointer is null");
  sphc_localizer_config other = config_;
  other.max_keypoints -= 1;
  Session smaller(other);
  sphc_localizer_result result = {};
  result.struct_size = sizeof result;
  EXPECT_EQ(sphc_localizer_locate(smaller.localizer(), &frame(0), features_.handle, &result), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_localizer_locate(nullptr, &frame(0), features_.handle, &result), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_localizer_locate(session.localizer(), &frame(0), features_.handle, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_localizer_locate(session.localizer(), &frame(0), features_.handle, &result), SPHC_OK);
}

TEST_F(Halves, MemoryIsNotTheLocalizers) {
  Session session(config_);
  sphc_features *inside = nullptr;
  ASSERT_EQ(sphc_features_init(session.scratch().data(), session.scratch().size(), &config_, &inside, nullptr),
            SPHC_OK);
  EXPECT_EQ(sphc_localizer_extract(session.localizer(), &frame(0), inside), SPHC_E_ARGUMENT);
  expectMentions(sphc_features_message(inside), "scratch memory overlaps features");
}

TEST_F(Halves, ImagesAreNotInTheLocalizersMemory) {
  Session session(config_);
  sphc_localizer_frame wrong = frame(0);
  wrong.color.data = session.scratch().data();
  EXPECT_EQ(sphc_localizer_extract(session.localizer(), &wrong, features_.handle), SPHC_E_ARGUMENT);
  expectMentions(sphc_features_message(features_.handle), "scratch memory overlaps the color image");
}

TEST_F(Halves, EachHalfHasItsDeadline) {
  sphc::test::SteppingClock clock(200000);
  config_.clock = &sphc::test::SteppingClock::read;
  config_.clock_user = &clock;
  Session session(config_);
  sphc_localizer_frame soon = frame(0);
  soon.deadline_us = 2000;
  ASSERT_EQ(sphc_localizer_extract(session.localizer(), &soon, features_.handle), SPHC_OK);
  const Answer cut = located(&session, frame(0), features_);
  EXPECT_TRUE(cut.result.cuts & SPHC_CUT_FEATURES);
  EXPECT_GT(cut.result.features_us, 0u);
  const sphc_features_arrays arrays = features_.arrays();
  ASSERT_EQ(sphc_features_set(features_.handle, &frame(0), &arrays), SPHC_OK);  // their own: nobody was in haste
  const Answer set = located(&session, frame(0), features_);
  EXPECT_EQ(set.result.cuts, 0u);
  EXPECT_EQ(set.result.features_us, 0u);
  ASSERT_EQ(sphc_localizer_extract(session.localizer(), &frame(1), features_.handle), SPHC_OK);
  EXPECT_EQ(located(&session, frame(1), features_).result.cuts, 0u);
  soon = frame(1);
  soon.deadline_us = 1;
  EXPECT_EQ(located(&session, soon, features_).result.outcome, SPHC_OUTCOME_DEADLINE);
}

TEST_F(Halves, InCpp) {
  Session session(config_);
  spherecloud::Localizer localizer;
  spherecloud::Features features, none;
  ASSERT_TRUE(spherecloud::Localizer::make(config_, &localizer).ok());
  ASSERT_TRUE(spherecloud::Features::make(config_, &features).ok());
  ASSERT_EQ(sphc_localizer_set_map(localizer.get(), 0, session.map()), SPHC_OK);
  sphc_localizer_result result = spherecloud::emptyResult();
  EXPECT_EQ(localizer.locate(frame(0), features, &result).code(), SPHC_E_STATE);
  EXPECT_TRUE(localizer.extract(frame(0), &features).ok());
  sphc_features_arrays arrays = {};
  EXPECT_TRUE(features.arrays(&arrays).ok());
  EXPECT_TRUE(features.set(frame(0), arrays).ok());
  const spherecloud::Status status = localizer.locate(frame(1), features, &result);
  EXPECT_EQ(status.code(), SPHC_E_ARGUMENT);
  expectMentions(status.text(), "features of its own image");
  ++arrays.extractor;
  expectMentions(features.set(frame(0), arrays).text(), "arrays.extractor is");
  EXPECT_EQ(localizer.extract(frame(0), &none).code(), SPHC_E_ARGUMENT);
  const spherecloud::Features moved = std::move(features);
  EXPECT_FALSE(features);
  EXPECT_TRUE(localizer.locate(frame(0), moved, &result).ok());
}

TEST_F(Halves, MemoryIsChecked) {
  sphc_message message = {};
  sphc_memory need = {};
  EXPECT_EQ(sphc_features_memory(nullptr, &need, &message), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_features_memory(&config_, nullptr, &message), SPHC_E_ARGUMENT);
  ASSERT_EQ(sphc_features_memory(&config_, &need, &message), SPHC_OK);
  GuardedMemory memory(need.state_bytes + 64, need.alignment);
  auto *bytes = static_cast<uint8_t *>(memory.data());
  sphc_features *made = nullptr;
  const size_t enough = need.state_bytes;
  EXPECT_EQ(sphc_features_init(nullptr, enough, &config_, &made, &message), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_features_init(bytes, enough, nullptr, &made, &message), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_features_init(bytes, enough, &config_, nullptr, &message), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_features_init(bytes + 1, enough, &config_, &made, &message), SPHC_E_MEMORY_ALIGNMENT);
  EXPECT_EQ(sphc_features_init(bytes, enough - 1, &config_, &made, &message), SPHC_E_MEMORY_SIZE);
  expectMentions(message.text, "features memory has");
  EXPECT_EQ(made, nullptr);
  sphc_features_fini(&made);
  sphc_features_fini(nullptr);
  EXPECT_STREQ(sphc_features_message(nullptr), "features is null");
}

TEST_F(Halves, TheUpperBoundHolds) {
  for (uint32_t keypoints : {64u, 800u, 4096u})
    for (uint32_t side : {16u, 640u, 8192u}) {
      config_.max_keypoints = keypoints;
      config_.rig.color_camera = sphc::test::pinhole(side, side, side);
      sphc_memory need = {};
      ASSERT_EQ(sphc_features_memory(&config_, &need, nullptr), SPHC_OK);
      EXPECT_LE(need.state_bytes, SPHC_FEATURES_BYTES_MAX(keypoints, side, side));
    }
}

}  // namespace
