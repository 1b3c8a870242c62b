#include "drivers/simulated/menu.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "handle.h"

namespace sphc::simulated::test {
namespace {

using Image = std::vector<uint8_t>;

constexpr uint32_t kWidth = SPHC_SIMULATED_COLOR_WIDTH, kHeight = SPHC_SIMULATED_COLOR_HEIGHT;

Image colorOf(uint32_t with, uint32_t frame) {
  sphc_simulated_config config = defaults();
  config.with = with;
  config.color_noise = config.motion_blur = 0;
  const Handle room(config);
  Image rgb(3 * kColorPixels);
  EXPECT_EQ(sphc_simulated_render_color(room.get(), frame, rgb.data()), SPHC_OK);
  return rgb;
}

double shareOfOthers(const Image &a, const Image &b) {
  size_t others = 0;
  for (size_t i = 0; i < a.size(); i += 3) others += a[i] != b[i] || a[i + 1] != b[i + 1] || a[i + 2] != b[i + 2];
  return 3.0 * static_cast<double>(others) / static_cast<double>(a.size());
}

TEST(SimulatedMenu, CoversATenthOfTheImage) {
  const double share = shareOfOthers(colorOf(0, 3), colorOf(SPHC_SIMULATED_MENU, 3));
  EXPECT_GT(share, 0.05);
  EXPECT_LT(share, 0.2);
}

TEST(SimulatedMenu, LiesInTheSmallestImageToo) {
  constexpr uint32_t kSmallWidth = 480, kSmallHeight = 360;
  constexpr size_t kGuard = size_t{3} * kSmallWidth * 40;
  Image guarded(2 * kGuard + size_t{3} * kSmallWidth * kSmallHeight, 128);
  const Image before = guarded;
  drawMenu(3.1, kSmallWidth, kSmallHeight, guarded.data() + kGuard);
  EXPECT_NE(guarded, before);
  EXPECT_TRUE(std::equal(before.begin(), before.begin() + kGuard, guarded.begin()));
  EXPECT_TRUE(std::equal(before.end() - kGuard, before.end(), guarded.end() - kGuard));
}

TEST(SimulatedMenu, StaysButForItsTime) {
  const Image none(3 * kColorPixels, 128);
  Image first = none, soon = none, later = none;
  drawMenu(3.1, kWidth, kHeight, first.data());
  drawMenu(3.9, kWidth, kHeight, soon.data());
  drawMenu(14.2, kWidth, kHeight, later.data());
  EXPECT_EQ(first, soon);
  EXPECT_GT(shareOfOthers(first, later), 0);
  EXPECT_LT(shareOfOthers(first, later), 0.1 * shareOfOthers(first, none));
}

}  // namespace
}  // namespace sphc::simulated::test
