#include "drivers/simulated/light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "drivers/simulated/scene.h"
#include "handle.h"

namespace sphc::simulated::test {
namespace {

struct Tone {
  double red = 0, blue = 0;  // means of the floor, of 255
  double brightest = 0;
};

// The floor of the room, painted of one grey, under a light.
Tone floorUnder(uint32_t with) {
  sphc_simulated_config config = defaults();
  config.seed = 7;
  std::vector<Job> jobs;
  const Scene scene = buildScene(config, jobs);
  const Bvh bvh(scene.shapes);
  TexturePool pool;
  const uint32_t index = pool.add(6, 5, 0.05f);
  const Texture texture = pool.texture(index);
  const size_t count = size_t{texture.width} * texture.height;
  std::vector<Texel> texels(count, 0x80808080u);
  shade(bvh, scene.plan, lightingOf(with), scene.shapes[0], 4, texture, texels.data());
  Tone tone;
  for (const Texel texel : texels) {
    tone.red += (texel & 255) / static_cast<double>(count);
    tone.blue += ((texel >> 16) & 255) / static_cast<double>(count);
    tone.brightest = std::max(tone.brightest, static_cast<double>(texel & 255));
  }
  return tone;
}

TEST(SimulatedLight, DayIsBlueAndSunnyNightWarmDarkDim) {
  const Tone plain = floorUnder(0), day = floorUnder(SPHC_SIMULATED_DAY), night = floorUnder(SPHC_SIMULATED_NIGHT),
             dark = floorUnder(SPHC_SIMULATED_DARK);
  const auto warmth = [](const Tone &tone) { return tone.red / tone.blue; };
  EXPECT_LT(warmth(day), warmth(plain));
  EXPECT_GT(warmth(night), 1.2 * warmth(plain));
  EXPECT_LT(dark.red, 0.8 * plain.red);
  EXPECT_GT(day.brightest, 1.5 * day.red) << "the sun's patch";
}

// Grey of a colour image, and how much of it is noise.
struct Grey {
  double mean = 0, noise = 0;
};
Grey greyWith(uint32_t with) {
  sphc_simulated_config config = defaults();
  config.seed = 7;
  config.with = with;
  std::vector<uint8_t> noisy(3 * kColorPixels), clean(3 * kColorPixels);
  EXPECT_EQ(sphc_simulated_render_color(Handle(config).get(), 0, noisy.data()), SPHC_OK);
  config.color_noise = 0;
  EXPECT_EQ(sphc_simulated_render_color(Handle(config).get(), 0, clean.data()), SPHC_OK);
  Grey grey;
  const auto count = static_cast<double>(noisy.size());
  for (size_t i = 0; i < noisy.size(); ++i) {
    grey.mean += clean[i] / count;
    grey.noise += std::pow(noisy[i] - clean[i], 2) / count;
  }
  grey.noise = std::sqrt(grey.noise);
  return grey;
}

TEST(SimulatedLight, NoiseRisesAsLightFalls) {
  // In good light it is 2 of 255, and the mean about 100.
  const Grey dark = greyWith(SPHC_SIMULATED_DARK);
  EXPECT_LT(dark.mean, 60);
  EXPECT_GT(dark.noise, 6);
}

}  // namespace
}  // namespace sphc::simulated::test
