// The poses that a frame may have.
#include <gtest/gtest.h>

#include <cstring>

#include "tests/capi/bytes.h"
#include "tests/support/session.h"

namespace {

using sphc::test::Output;
using sphc::test::Session;

class CInterfaceHypotheses : public testing::Test {
 protected:
  std::vector<sphc_localizer_hypothesis> hypotheses() {
    std::vector<sphc_localizer_hypothesis> list(SPHC_HYPOTHESES_MAX);
    uint32_t count = SPHC_HYPOTHESES_MAX + 1;
    EXPECT_EQ(
        sphc_localizer_hypotheses(session_.localizer(), list.data(), sizeof list[0], SPHC_HYPOTHESES_MAX, &count),
        SPHC_OK);
    EXPECT_LE(count, SPHC_HYPOTHESES_MAX);
    list.resize(count);
    return list;
  }

  const sphc_localizer_config config_ = sphc::test::sceneConfig();
  Session session_{config_};
};

TEST_F(CInterfaceHypotheses, ThereAreNoneBeforeTheFirstFrame) { EXPECT_TRUE(hypotheses().empty()); }

TEST_F(CInterfaceHypotheses, TheResultIsOneOfThem) {
  const auto frame = sphc::test::sceneFrame(config_, 1);
  sphc_localizer_result result = {};
  ASSERT_EQ(session_.process(frame->frame, &result), SPHC_OK);
  uint32_t results = 0;
  double gain = std::numeric_limits<double>::infinity();
  for (const sphc_localizer_hypothesis &each : hypotheses()) {
    EXPECT_LE(each.gain, gain);
    gain = each.gain;
    EXPECT_EQ(each.map_id, 0u);
    EXPECT_LT(each.log_chance, -6);
    if (!each.is_result) continue;
    ++results;
    EXPECT_EQ(each.outcome, SPHC_OUTCOME_LOCALIZED);
    EXPECT_EQ(each.inliers, result.inliers);
    EXPECT_EQ(std::memcmp(&each.camera_from_map, &result.camera_from_map, sizeof result.camera_from_map), 0);
  }
  EXPECT_EQ(results, 1u);
}

TEST_F(CInterfaceHypotheses, AFrameOfAnotherPlaceHasNone) {
  const auto frame = sphc::test::sceneFrame(config_, 1), other = sphc::test::sceneFrame(config_, 1, 5);
  sphc_localizer_result result = {};
  ASSERT_EQ(session_.process(frame->frame, &result), SPHC_OK);
  ASSERT_EQ(session_.process(other->frame, &result), SPHC_NOT_LOCALIZED);
  EXPECT_TRUE(hypotheses().empty());
}

TEST_F(CInterfaceHypotheses, CopiesAsManyAsThereIsRoomForAtTheCallersStride) {
  const auto frame = sphc::test::sceneFrame(config_, 1);
  sphc_localizer_result result = {};
  ASSERT_EQ(session_.process(frame->frame, &result), SPHC_OK);
  constexpr uint32_t kStride = sizeof(sphc_localizer_hypothesis) + 8;
  alignas(8) unsigned char room[2 * kStride];
  std::memset(room, 0x5A, sizeof room);
  uint32_t count = 0;
  EXPECT_EQ(sphc_localizer_hypotheses(session_.localizer(), reinterpret_cast<sphc_localizer_hypothesis *>(room),
                                      kStride, 1, &count),
            SPHC_OK);
  EXPECT_GE(count, 1u);
  for (uint32_t i = kStride - 8; i < kStride; ++i) EXPECT_EQ(room[i], 0) << i;
  for (uint32_t i = kStride; i < 2 * kStride; ++i) EXPECT_EQ(room[i], 0x5A) << i;
}

TEST_F(CInterfaceHypotheses, ForbiddenCalls) {
  Output<uint32_t> count;
  sphc_localizer_hypothesis one;
  EXPECT_EQ(sphc_localizer_hypotheses(nullptr, &one, sizeof one, 1, count.get()), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_localizer_hypotheses(session_.localizer(), &one, sizeof one, 1, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_localizer_hypotheses(session_.localizer(), nullptr, sizeof one, 1, count.get()), SPHC_E_ARGUMENT);
  for (uint32_t stride : {0u, uint32_t{sizeof one} - 8, uint32_t{sizeof one} + 1})
    EXPECT_EQ(sphc_localizer_hypotheses(session_.localizer(), &one, stride, 1, count.get()), SPHC_E_ARGUMENT);
  EXPECT_TRUE(count.untouched());
}

}  // namespace
