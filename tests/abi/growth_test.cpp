// Programs built with other headers than the library: older ones, which are kept in headers/, and newer ones.
#include <gtest/gtest.h>

#include <cstring>

#include "spherecloud/spherecloud_capture.h"
#include "tests/capi/bytes.h"
#include "tests/support/session.h"

extern "C" {
// older_session.c, by the header that it was compiled with.
int session_of_0_2(const void *file, size_t file_bytes, const sphc_rig *rig, const sphc_image *color,
                   const sphc_image *depth, sphc_rigid *camera_from_map);
}

namespace {

using sphc::test::expectMentions;
using sphc::test::Session;

class OtherHeaders : public testing::Test {
 protected:
  sphc_localizer_config config_ = sphc::test::sceneConfig();
  Session session_{config_};
  std::unique_ptr<sphc::test::SceneFrame> frame_ = sphc::test::sceneFrame(config_, 1);
};

TEST_F(OtherHeaders, AnOlderProgramGetsTheSamePose) {
  sphc_localizer_config defaults;
  ASSERT_EQ(sphc_localizer_config_init(&defaults, sizeof defaults), SPHC_OK);
  defaults.rig = config_.rig;
  Session of_today(defaults);
  sphc_localizer_result today = {};
  ASSERT_EQ(of_today.process(frame_->frame, &today), SPHC_OK);
  const auto &file = of_today.sceneMap().file;
  sphc_rigid pose = {};
  EXPECT_EQ(
      session_of_0_2(file.data(), file.size(), &config_.rig, &frame_->frame.color, &frame_->frame.depth, &pose), 0);
  EXPECT_EQ(std::memcmp(&pose, &today.camera_from_map, sizeof pose), 0);
}

// What a newer header might have: one field more.
template <typename T>
struct Newer {
  T base;
  uint64_t added;
};

TEST_F(OtherHeaders, ANewerProgramIsServedWhileItsNewFieldsAreZero) {
  Newer<sphc_localizer_frame> frame = {frame_->frame, 0};
  Newer<sphc_localizer_prior> prior = {};
  frame.base.struct_size = sizeof frame;
  prior.base.struct_size = sizeof prior;
  frame.base.prior = &prior.base;
  Newer<sphc_localizer_result> result;
  std::memset(&result, 0x5A, sizeof result);
  result.base.struct_size = sizeof result;
  EXPECT_EQ(sphc_localizer_process(session_.localizer(), &frame.base, &result.base), SPHC_OK)
      << sphc_localizer_message(session_.localizer());
  EXPECT_EQ(result.base.struct_size, sizeof result);
  EXPECT_EQ(result.added, 0u);

  prior.added = 1;
  EXPECT_EQ(sphc_localizer_process(session_.localizer(), &frame.base, &result.base), SPHC_E_UNSUPPORTED);
  expectMentions(sphc_localizer_message(session_.localizer()), "prior is of a newer header");
  prior.added = 0;
  frame.added = 1;
  EXPECT_EQ(sphc_localizer_process(session_.localizer(), &frame.base, &result.base), SPHC_E_UNSUPPORTED);
  expectMentions(sphc_localizer_message(session_.localizer()), "frame is of a newer header");
}

TEST_F(OtherHeaders, ANewerConfigIsServedWhileItsNewFieldsAreZero) {
  Newer<sphc_localizer_config> config;
  std::memset(&config, 0x5A, sizeof config);
  ASSERT_EQ(sphc_localizer_config_init(&config.base, sizeof config), SPHC_OK);
  EXPECT_EQ(config.added, 0u);
  config.base.rig = config_.rig;
  sphc_memory newer = {}, known = {};
  sphc_message message = {};
  EXPECT_EQ(sphc_localizer_memory(&config.base, &newer, &message), SPHC_OK) << message.text;
  config.base.struct_size = sizeof config.base;
  EXPECT_EQ(sphc_localizer_memory(&config.base, &known, &message), SPHC_OK);
  EXPECT_EQ(newer.state_bytes, known.state_bytes);
  config.base.struct_size = sizeof config;
  config.added = 1;
  EXPECT_EQ(sphc_localizer_memory(&config.base, &newer, &message), SPHC_E_UNSUPPORTED);
  expectMentions(message.text, "config is of a newer header");
}

// Of a struct that is only set or only written: through the function that does so.
template <typename T>
T written() {
  T value;
  std::memset(&value, 0x5A, sizeof value);
  return value;
}

TEST_F(OtherHeaders, EveryOtherStructHasRoomToGrow) {
  auto info = written<Newer<sphc_map_info>>();
  info.base.struct_size = sizeof info;
  EXPECT_EQ(sphc_map_get_info(session_.map(), &info.base), SPHC_OK);
  EXPECT_EQ(info.added, 0u);
  EXPECT_EQ(info.base.struct_size, sizeof info);
  auto aligner = written<Newer<sphc_aligner_config>>();
  EXPECT_EQ(sphc_aligner_config_init(&aligner.base, sizeof aligner), SPHC_OK);
  EXPECT_EQ(aligner.added, 0u);
  auto pairer = written<Newer<sphc_pairer_config>>();
  EXPECT_EQ(sphc_pairer_config_init(&pairer.base, sizeof pairer), SPHC_OK);
  EXPECT_EQ(pairer.added, 0u);
  auto mapper = written<Newer<sphc_clock_mapper_config>>();
  EXPECT_EQ(sphc_clock_mapper_config_init(&mapper.base, sizeof mapper), SPHC_OK);
  EXPECT_EQ(mapper.added, 0u);
}

}  // namespace
