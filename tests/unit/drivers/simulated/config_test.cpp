#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "handle.h"

namespace sphc::simulated::test {
namespace {

TEST(SimulatedConfig, DefaultsAreTwoLaps) {
  sphc_simulated_config config;
  ASSERT_EQ(sphc_simulated_config_init(&config, sizeof config), SPHC_OK);
  EXPECT_EQ(config.struct_size, sizeof config);
  EXPECT_DOUBLE_EQ(config.frame_count / config.frame_rate_hz, 2 * config.lap_s);
}

TEST(SimulatedConfig, InitRefusesWhatItDoesNotKnow) {
  sphc_simulated_config config;
  EXPECT_EQ(sphc_simulated_config_init(nullptr, sizeof config), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_simulated_config_init(&config, sizeof config - 8), SPHC_E_STRUCT_SIZE);
}

TEST(SimulatedConfig, OpenNamesTheFieldAndTheCure) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const struct {
    const char *name;
    std::function<void(sphc_simulated_config &)> spoil;
  } cases[] = {
      {"frame_count", [](auto &c) { c.frame_count = 0; }},
      {"frame_rate_hz", [&](auto &c) { c.frame_rate_hz = nan; }},
      {"lap_s", [](auto &c) { c.lap_s = 0; }},
      {"start_time_ns", [](auto &c) { c.start_time_ns = -1; }},
      {"depth_delay_ns", [](auto &c) { c.depth_delay_ns = 100000000; }},
      {"threads", [](auto &c) { c.threads = 65; }},
      {"color_noise", [](auto &c) { c.color_noise = 2; }},
      {"ideal_depth", [](auto &c) { c.ideal_depth = 7; }},
      {"raw_depth", [](auto &c) { c.raw_depth = 2; }},
      {"exposure_s", [](auto &c) { c.exposure_s = -0.001; }},
      {"depth_scale", [&](auto &c) { c.depth_scale = nan; }},
      {"depth_sigma_m", [](auto &c) { c.depth_sigma_m = -1; }},
      {"depth_max_m", [](auto &c) { c.depth_max_m = std::numeric_limits<double>::infinity(); }},
      {"with", [](auto &c) { c.with = 1u << 20; }},
      {"with", [](auto &c) { c.with = SPHC_SIMULATED_DAY | SPHC_SIMULATED_NIGHT; }},
      {"walk_start_s", [](auto &c) { c.walk_start_s = -1; }},
      {"cameras is 4", [](auto &c) { c.cameras = 4; }},
      {"color_row_time_ns", [](auto &c) { c.color_row_time_ns = 1000001; }},
      {"color_row_time_ns", [](auto &c) { c.color_row_time_ns = -1000001; }},
      {"a phone gives smoothed depth",
       [](auto &c) {
         c.raw_depth = 1;
         c.cameras = SPHC_SIMULATED_CAMERAS_PHONE;
       }},
  };
  for (const auto &c : cases) {
    sphc_simulated_config config = defaults();
    c.spoil(config);
    sphc_simulated *handle = nullptr;
    sphc_message message{};
    EXPECT_EQ(sphc_simulated_open(&config, &handle, &message), SPHC_E_ARGUMENT) << c.name;
    EXPECT_EQ(handle, nullptr);
    EXPECT_THAT(std::string(message.text), testing::HasSubstr(c.name));
    EXPECT_EQ(sphc_simulated_open(&config, &handle, nullptr), SPHC_E_ARGUMENT) << "without a message";
  }
}

TEST(SimulatedConfig, OpenRefusesNullAndUnknownSize) {
  sphc_simulated_config config = defaults();
  sphc_simulated *handle = nullptr;
  sphc_message message{};
  EXPECT_EQ(sphc_simulated_open(nullptr, &handle, &message), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_simulated_open(&config, nullptr, &message), SPHC_E_ARGUMENT);
  config.struct_size = 4;
  EXPECT_EQ(sphc_simulated_open(&config, &handle, &message), SPHC_E_STRUCT_SIZE);
  EXPECT_THAT(std::string(message.text), testing::HasSubstr("struct_size"));
}

TEST(SimulatedConfig, NullHandlesAreRefused) {
  sphc_rigid pose;
  int64_t time_ns = 0;
  sphc_source source{};
  source.struct_size = sizeof source;
  uint8_t byte = 0;
  EXPECT_EQ(sphc_simulated_pose_at(nullptr, 0, &pose), SPHC_E_ARGUMENT);
  sphc_rig rig;
  EXPECT_EQ(sphc_simulated_rig(nullptr, &rig), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_simulated_frame_times(nullptr, 0, &time_ns, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_simulated_source(nullptr, &source), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_simulated_render_color(nullptr, 0, &byte), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_simulated_frame_count(nullptr), 0u);
  sphc_simulated_close(nullptr);
  sphc_simulated *none = nullptr;
  sphc_simulated_close(&none);
}

}  // namespace
}  // namespace sphc::simulated::test
