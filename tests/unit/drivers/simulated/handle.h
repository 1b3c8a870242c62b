// handle.h - a simulated headset that closes itself.
#pragma once

#include <gtest/gtest.h>

#include "drivers/simulated/simulated.h"

namespace sphc::simulated::test {

inline sphc_simulated_config defaults() {
  sphc_simulated_config config;
  EXPECT_EQ(sphc_simulated_config_init(&config, sizeof config), SPHC_OK);
  config.frame_rate_hz = 6.25;
  config.frame_count = 200;
  return config;
}

class Handle {
 public:
  explicit Handle(const sphc_simulated_config &config) {
    sphc_message message{};
    EXPECT_EQ(sphc_simulated_open(&config, &handle_, &message), SPHC_OK) << message.text;
  }
  ~Handle() { sphc_simulated_close(&handle_); }
  Handle(const Handle &) = delete;
  Handle &operator=(const Handle &) = delete;
  sphc_simulated *get() const { return handle_; }

 private:
  sphc_simulated *handle_ = nullptr;
};

constexpr size_t kColorPixels = size_t{SPHC_SIMULATED_COLOR_WIDTH} * SPHC_SIMULATED_COLOR_HEIGHT;
constexpr size_t kDepthPixels = size_t{SPHC_SIMULATED_DEPTH_WIDTH} * SPHC_SIMULATED_DEPTH_HEIGHT;

}  // namespace sphc::simulated::test
