// A walk through the simulated room, as images.
#pragma once
#include <gtest/gtest.h>

#include <vector>

#include "drivers/simulated/simulated.h"

namespace sphc::host {

struct WalkImages {
  std::vector<uint8_t> color;  // RGB8, rows without gaps
  std::vector<uint16_t> depth;
};

// `rig` receives the cameras.  Rendering takes long: once for all tests.
inline std::vector<WalkImages> renderWalk(uint32_t frames, double rate_hz, sphc_rig *rig,
                                          uint32_t cameras = SPHC_SIMULATED_CAMERAS_HEADSET, uint32_t with = 0,
                                          uint64_t seed = 1) {
  sphc_simulated_config config;
  sphc_simulated_config_init(&config, sizeof config);
  config.frame_count = frames;
  config.frame_rate_hz = rate_hz;
  config.cameras = cameras;
  config.with = with;
  config.seed = seed;
  sphc_simulated *simulated = nullptr;
  EXPECT_EQ(sphc_simulated_open(&config, &simulated, nullptr), SPHC_OK);
  EXPECT_EQ(sphc_simulated_rig(simulated, rig), SPHC_OK);
  std::vector<WalkImages> walk(frames);
  for (uint32_t i = 0; i < frames; ++i) {
    walk[i].color.resize(size_t{3} * rig->color_camera.width * rig->color_camera.height);
    walk[i].depth.resize(size_t{rig->depth_camera.width} * rig->depth_camera.height);
    sphc_simulated_render_color(simulated, i, walk[i].color.data());
    sphc_simulated_render_depth(simulated, i, walk[i].depth.data());
  }
  sphc_simulated_close(&simulated);
  return walk;
}

}  // namespace sphc::host
