#include <gtest/gtest.h>

#include <vector>

#include "handle.h"

namespace sphc::simulated::test {
namespace {

struct Images {
  std::vector<uint8_t> rgb = std::vector<uint8_t>(3 * kColorPixels);
  std::vector<uint16_t> depth = std::vector<uint16_t>(kDepthPixels);
};

Images render(const Handle &handle, uint32_t index) {
  Images images;
  EXPECT_EQ(sphc_simulated_render_color(handle.get(), index, images.rgb.data()), SPHC_OK);
  EXPECT_EQ(sphc_simulated_render_depth(handle.get(), index, images.depth.data()), SPHC_OK);
  return images;
}

void expectSameBytes(sphc_simulated_config config) {
  config.seed = 5;
  config.threads = 1;
  const Handle one(config);
  config.threads = 3;
  const Handle three(config);
  // In another order, too.
  const Images a150 = render(one, 150), a0 = render(one, 0);
  const Images b0 = render(three, 0), b150 = render(three, 150);
  EXPECT_EQ(a0.rgb, b0.rgb);
  EXPECT_EQ(a0.depth, b0.depth);
  EXPECT_EQ(a150.rgb, b150.rgb);
  EXPECT_EQ(a150.depth, b150.depth);
  EXPECT_NE(a0.rgb, a150.rgb);
}

TEST(SimulatedHeadset, SameConfigSameBytesWhateverTheThreads) { expectSameBytes(defaults()); }

TEST(SimulatedHeadset, SameBytesInAHardWorld) {
  sphc_simulated_config config = defaults();
  config.with = SPHC_SIMULATED_HANDS | SPHC_SIMULATED_FEET | SPHC_SIMULATED_PEOPLE | SPHC_SIMULATED_TILES |
                SPHC_SIMULATED_DOUBLES | SPHC_SIMULATED_MIRROR | SPHC_SIMULATED_WINDOW | SPHC_SIMULATED_NIGHT;
  config.arrangement_seed = 3;
  expectSameBytes(config);
}

TEST(SimulatedHeadset, AWalkMayBeginWithItsSecondLap) {
  sphc_simulated_config config = defaults();
  const Handle whole(config);
  config.walk_start_s = config.lap_s;
  const Handle second(config);
  const Images a = render(whole, 100), b = render(second, 0);
  EXPECT_EQ(a.rgb, b.rgb);
  EXPECT_EQ(a.depth, b.depth);
}

}  // namespace
}  // namespace sphc::simulated::test
