// The soak's checks see what they are there for.
#include "tests/soak/checks.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace sphc::soak {
namespace {

struct Answer {
  sphc_localizer_frame frame = {};
  sphc_localizer_result result;

  Answer() {
    sphc_localizer_result_init(&result, sizeof result);
    frame.color_time_ns = result.time_ns = 7;
    for (int i = 0; i < 6; ++i) result.covariance[7 * i] = 1e-4;
    result.confidence = 0.9;
    result.keypoints = result.lifted = result.inliers = 20;
  }
  std::string fault(sphc_status status = SPHC_OK) const {
    const char *text = faultOf(status, frame, result);
    return text ? text : "";
  }
};

TEST(SoakChecks, AGoodAnswerHasNoFault) { EXPECT_EQ(Answer().fault(), ""); }

TEST(SoakChecks, EveryFaultIsSeen) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto spoiled = [](auto spoil) {
    Answer answer;
    spoil(&answer.result);
    return answer.fault();
  };
  EXPECT_NE(Answer().fault(SPHC_AGAIN), "");
  EXPECT_NE(Answer().fault(SPHC_NOT_LOCALIZED), "");
  EXPECT_NE(spoiled([](auto *r) { r->state = 3; }), "");
  EXPECT_NE(spoiled([](auto *r) { r->time_ns = 8; }), "");
  EXPECT_NE(spoiled([](auto *r) { r->sequence = 8; }), "");
  EXPECT_NE(spoiled([&](auto *r) { r->camera_from_map.t_m[1] = nan; }), "");
  EXPECT_NE(spoiled([](auto *r) { r->camera_from_map.q_wxyz[1] = 0.1; }), "");
  EXPECT_NE(spoiled([](auto *r) { r->covariance[1] = 1e-5; }), "") << "not symmetric";
  EXPECT_NE(spoiled([](auto *r) { r->covariance[1] = r->covariance[6] = 2e-4; }), "") << "not positive";
  EXPECT_NE(spoiled([](auto *r) { r->covariance[35] = 0; }), "");
  EXPECT_NE(spoiled([](auto *r) { r->confidence = 1.01; }), "");
  EXPECT_NE(spoiled([&](auto *r) { r->confidence = nan; }), "");
  EXPECT_NE(spoiled([](auto *r) { r->lifted = 21; }), "");
}

TEST(SoakChecks, WithoutAPoseNothingIsSaidOfOne) {
  Answer answer;
  answer.result.outcome = SPHC_OUTCOME_FEW_MATCHES;
  EXPECT_NE(answer.fault(SPHC_NOT_LOCALIZED), "");
  std::fill(answer.result.covariance, answer.result.covariance + 36, 0.0);
  answer.result.confidence = 0;
  EXPECT_EQ(answer.fault(SPHC_NOT_LOCALIZED), "");
}

TEST(SoakChecks, PredictionsAndHypotheses) {
  sphc_localizer_prediction prediction;
  sphc_localizer_prediction_init(&prediction, sizeof prediction);
  EXPECT_EQ(faultOf(SPHC_NOT_LOCALIZED, prediction), nullptr);
  EXPECT_NE(faultOf(SPHC_OK, prediction), nullptr) << "a pose has a covariance";
  EXPECT_NE(faultOf(SPHC_E_ARGUMENT, prediction), nullptr);
  sphc_localizer_hypothesis list[2] = {};
  for (sphc_localizer_hypothesis &each : list) each.camera_from_map.q_wxyz[0] = 1;
  EXPECT_EQ(faultOf(list, 2), nullptr);
  list[1].gain = 1;
  EXPECT_NE(faultOf(list, 2), nullptr) << "the second has more";
}

TEST(SoakChecks, MostFramesHaveAPoseAndNoneIsWrong) {
  Totals totals;
  EXPECT_NE(faultOf(totals), nullptr) << "no frame at all";
  totals.frames = 100;
  totals.elsewhere = 30;
  totals.broken = 10;
  totals.localized = 31;
  EXPECT_EQ(faultOf(totals), nullptr);
  totals.wrong_pose = 1;
  EXPECT_NE(faultOf(totals), nullptr);
  totals.wrong_pose = 0;
  totals.localized = 30;
  EXPECT_NE(faultOf(totals), nullptr) << "not more than half";
}

TEST(SoakChecks, AWriteBesideABufferIsSeen) {
  Guarded<uint32_t> value;
  EXPECT_TRUE(value.isIntact());
  reinterpret_cast<uint8_t *>(value.get())[8] = 1;
  EXPECT_FALSE(value.isIntact());
}

TEST(SoakChecks, ADigestDependsOnEveryByte) {
  const uint8_t a[] = {1, 2}, b[] = {1, 3};
  EXPECT_NE(digestOf(a, 2, 5), digestOf(b, 2, 5));
  EXPECT_EQ(digestOf(a, 2, 5), digestOf(a + 1, 1, digestOf(a, 1, 5)));
}

}  // namespace
}  // namespace sphc::soak
