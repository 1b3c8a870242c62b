#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "drivers/simulated/simulated.h"
#include "host/live/device.h"
#include "tests/support/refusal.h"

namespace sphc::host {
namespace {

using testing::HasSubstr;

// The first image of a source, which is of colour.
std::vector<uint8_t> firstImageOf(const sphc_source &source) {
  EXPECT_EQ(source.start(source.self), SPHC_OK);
  sphc_capture capture = {};
  capture.struct_size = sizeof capture;
  EXPECT_EQ(source.acquire(source.self, 0, &capture), SPHC_OK);
  const auto *bytes = static_cast<const uint8_t *>(capture.image.data);
  std::vector<uint8_t> image(bytes, bytes + size_t{capture.image.stride_bytes} * capture.image.height);
  source.stop(source.self);
  return image;
}

std::vector<uint8_t> firstImageOf(const sphc_simulated_config &config) {
  sphc_simulated *simulated = nullptr;
  EXPECT_EQ(sphc_simulated_open(&config, &simulated, nullptr), SPHC_OK);
  sphc_source source = {};
  source.struct_size = sizeof source;
  EXPECT_EQ(sphc_simulated_source(simulated, &source), SPHC_OK);
  std::vector<uint8_t> image = firstImageOf(source);
  sphc_simulated_close(&simulated);
  return image;
}

TEST(SimulatedDevice, RowsAreExposedOneAfterAnotherWhereTheAddressSaysSo) {
  sphc_simulated_config config;
  ASSERT_EQ(sphc_simulated_config_init(&config, sizeof config), SPHC_OK);
  config.seed = 3;
  config.cameras = SPHC_SIMULATED_CAMERAS_GLASSES;
  const auto at_once = firstImageOf(config);
  config.color_row_time_ns = -60000;
  const auto rolling = firstImageOf(config);
  ASSERT_NE(rolling, at_once);
  EXPECT_EQ(firstImageOf(openDevice("simulated:seed=3,cameras=glasses,row-time-ns=-60000", {})->source()), rolling);
}

TEST(SimulatedDevice, SaysWhoseCamerasItHas) {
  EXPECT_EQ(openDevice("simulated:", {})->describe(), "simulated headset, cameras=headset");
  EXPECT_EQ(openDevice("simulated:cameras=wide", {})->describe(), "simulated headset, cameras=wide");
}

std::string refusalOf(const std::string &spec) {
  return test::refusal([&] { openDevice(spec, {}); });
}

TEST(SimulatedDevice, RefusesWhatIsNoRowTime) {
  EXPECT_THAT(refusalOf("simulated:row-time-ns=slow"), HasSubstr("row-time-ns=slow has no number"));
  EXPECT_THAT(refusalOf("simulated:row-time-ns=2000000"), HasSubstr("color_row_time_ns is 2e+06; set it from"));
  EXPECT_THAT(refusalOf("simulated:row-time=5"),
              HasSubstr("row-time is unknown; there are seed=, walk-seed=, arrangement=, row-time-ns="));
}

}  // namespace
}  // namespace sphc::host
