#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "handle.h"

namespace sphc::simulated::test {
namespace {

constexpr double kFrameS = 20;  // on the walk
constexpr int64_t kRowTimeNs = 60000;

// Of a room with people who walk; nothing but time tells two images apart.
sphc_simulated_config configAt(double walk_s) {
  sphc_simulated_config config = defaults();
  config.seed = 3;
  config.with = SPHC_SIMULATED_PEOPLE;
  config.walk_start_s = walk_s;
  config.color_noise = config.motion_blur = config.exposure_drift = 0;
  return config;
}

std::vector<uint8_t> colorOf(const sphc_simulated_config &config) {
  const Handle handle(config);
  std::vector<uint8_t> rgb(3 * kColorPixels);
  EXPECT_EQ(sphc_simulated_render_color(handle.get(), 0, rgb.data()), SPHC_OK);
  return rgb;
}

// How many values of a row differ by more than the rounding of a time.
long differing(const std::vector<uint8_t> &a, const std::vector<uint8_t> &b, uint32_t row) {
  constexpr size_t kRow = size_t{3} * SPHC_SIMULATED_COLOR_WIDTH;
  long count = 0;
  for (size_t i = row * kRow; i < (row + 1) * kRow; ++i) count += a[i] > b[i] + 2 || b[i] > a[i] + 2;
  return count;
}

TEST(SimulatedRollingShutter, EachRowIsOfItsOwnMoment) {
  sphc_simulated_config config = configAt(kFrameS);
  const std::vector<uint8_t> at_once = colorOf(config);
  config.color_row_time_ns = kRowTimeNs;
  const std::vector<uint8_t> rolling = colorOf(config);
  config.color_row_time_ns = -kRowTimeNs;
  const std::vector<uint8_t> upwards = colorOf(config);
  constexpr long kFew = 20, kMany = 200;
  for (const uint32_t row : {0u, 479u}) {
    const double since_middle_s = (row + 0.5 - 0.5 * SPHC_SIMULATED_COLOR_HEIGHT) * kRowTimeNs * 1e-9;
    EXPECT_LT(differing(rolling, colorOf(configAt(kFrameS + since_middle_s)), row), kFew) << row;
    EXPECT_LT(differing(upwards, colorOf(configAt(kFrameS - since_middle_s)), row), kFew) << row;
    EXPECT_GT(differing(rolling, at_once, row), kMany) << row;
  }
  EXPECT_LT(differing(rolling, at_once, SPHC_SIMULATED_COLOR_HEIGHT / 2), kFew) << "the middle is the frame's";
}

TEST(SimulatedRollingShutter, DepthIsMeasuredAtOnce) {
  const auto depth_of = [](const sphc_simulated_config &config) {
    const Handle handle(config);
    std::vector<uint16_t> depth(kDepthPixels);
    EXPECT_EQ(sphc_simulated_render_depth(handle.get(), 0, depth.data()), SPHC_OK);
    return depth;
  };
  sphc_simulated_config config = configAt(kFrameS);
  const std::vector<uint16_t> at_once = depth_of(config);
  config.color_row_time_ns = kRowTimeNs;
  EXPECT_EQ(depth_of(config), at_once);
}

}  // namespace
}  // namespace sphc::simulated::test
