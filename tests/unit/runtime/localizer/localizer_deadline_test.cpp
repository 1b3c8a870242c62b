// Whole frames against the clock: time is the number of times it is read, so the same frame is cut at every place.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "runtime/localizer/localizer.h"
#include "tests/support/map_bytes.h"
#include "tests/support/random_numbers.h"
#include "tests/support/session.h"
#include "tests/support/stepping_clock.h"

namespace sphc {
namespace {

// So many looks at the clock may follow a deadline: each part ends with one or two.
constexpr uint64_t kMostLooksAfter = 40;

class LocalizerDeadline : public testing::Test {
 protected:
  LocalizerDeadline() {
    config_.clock = &test::SteppingClock::read;
    config_.clock_user = &clock_;
  }
  // Of a frame of viewpoint 1, under a deadline that many looks away (1 us each); 0: none.
  sphc_localizer_result see(test::Session *session, uint32_t looks, uint32_t viewpoint = 1) {
    const auto made = test::sceneFrame(config_, viewpoint);
    made->frame.deadline_us = looks;
    sphc_localizer_result result = {};
    result.struct_size = sizeof result;
    const uint64_t before = clock_.reads;
    session->process(made->frame, &result);
    looks_ = clock_.reads - before;
    return result;
  }

  test::SteppingClock clock_{1000};
  sphc_localizer_config config_ = test::sceneConfig();
  uint64_t looks_ = 0;  // of the last frame
};

TEST_F(LocalizerDeadline, WithoutOneTheClockIsReadForTheTimesAlone) {
  test::Session session(config_);
  EXPECT_EQ(see(&session, 0).cuts, 0u);
  EXPECT_LT(looks_, 60u);
}

TEST_F(LocalizerDeadline, EndsSoonAfterEveryOneAndSaysWhatWasCut) {
  test::Session session(config_);
  const sphc_localizer_result whole = see(&session, 1000000);
  ASSERT_EQ(whole.outcome, SPHC_OUTCOME_LOCALIZED);
  EXPECT_EQ(whole.cuts, 0u);
  const auto all = static_cast<uint32_t>(looks_);
  uint32_t cuts = 0, localized_though_cut = 0;
  for (uint32_t looks = 1; looks < 2 * all; looks += 1 + all / 150) {
    const sphc_localizer_result result = see(&session, looks);
    EXPECT_LE(looks_, looks + kMostLooksAfter) << looks;
    if (result.outcome == SPHC_OUTCOME_LOCALIZED) {
      EXPECT_LT(session.errorM(result, 1), 0.05) << looks;
      localized_though_cut += result.cuts != 0;
    } else {
      EXPECT_NE(result.cuts, 0u) << looks;
      EXPECT_EQ(result.outcome, SPHC_OUTCOME_DEADLINE) << looks;
    }
    cuts |= result.cuts;
  }
  EXPECT_EQ(cuts, uint32_t{SPHC_CUT_FEATURES | SPHC_CUT_MATCHES | SPHC_CUT_SEARCH | SPHC_CUT_VERIFICATION});
  EXPECT_GT(localized_though_cut, 10u) << "the best pose so far";
  EXPECT_EQ(see(&session, 4 * all).cuts, 0u);
}

TEST_F(LocalizerDeadline, TrackingEndsInTimeToo) {
  config_.mode = SPHC_MODE_TRACKING;
  test::Session session(config_);
  see(&session, 1000000);
  const auto all = static_cast<uint32_t>(looks_);
  for (uint32_t looks = 1; looks < all; looks += 1 + all / 40) {
    see(&session, looks, looks % 4);
    EXPECT_LE(looks_, looks + kMostLooksAfter) << looks;
  }
}

}  // namespace
}  // namespace sphc
