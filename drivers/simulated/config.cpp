#include "drivers/simulated/config.h"

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>

#include "drivers/simulated/cameras.h"
#include "drivers/simulated/with.h"

namespace sphc::simulated {
namespace {

sphc_status checkNumber(const char *name, double value, double low, double high, sphc_message *message) {
  // Written so that NaN fails.
  if (value >= low && value <= high) return SPHC_OK;
  explain(message, "simulated: %s is %g; set it from %g to %g", name, value, low, high);
  return SPHC_E_ARGUMENT;
}

sphc_status checkSwitch(const char *name, uint32_t value, sphc_message *message) {
  if (value <= 1) return SPHC_OK;
  explain(message, "simulated: %s is %u; set it to 0 or 1", name, value);
  return SPHC_E_ARGUMENT;
}

}  // namespace

void explain(sphc_message *message, const char *format, ...) {
  if (message == nullptr) return;
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(message->text, sizeof message->text, format, arguments);
  va_end(arguments);
}

sphc_status checkConfig(const sphc_simulated_config *config, sphc_message *message) {
  if (config == nullptr) {
    explain(message, "simulated: config is null; fill one with sphc_simulated_config_init");
    return SPHC_E_ARGUMENT;
  }
  const sphc_simulated_config &c = *config;
  if (c.struct_size != sizeof c) {
    explain(message, "simulated: config.struct_size is %u, this library knows %u; call sphc_simulated_config_init",
            c.struct_size, static_cast<unsigned>(sizeof c));
    return SPHC_E_STRUCT_SIZE;
  }
  const struct {
    const char *name;
    double value, low, high;
  } numbers[] = {
      {"frame_count", static_cast<double>(c.frame_count), 1, 1e6},
      {"frame_rate_hz", c.frame_rate_hz, 0.1, 240},
      {"lap_s", c.lap_s, 4, 3600},
      {"start_time_ns", static_cast<double>(c.start_time_ns), 0, 2305843009213693952.0},
      {"threads", static_cast<double>(c.threads), 0, 64},
      {"exposure_s", c.exposure_s, 0, 0.05},
      {"depth_scale", c.depth_scale, 0.8, 1.2},
      {"depth_offset_m", c.depth_offset_m, -0.5, 0.5},
      {"depth_wiggle_m", c.depth_wiggle_m, 0, 0.1},
      {"depth_sigma_m", c.depth_sigma_m, 0, 1},
      {"depth_sigma_per_m2", c.depth_sigma_per_m2, 0, 1},
      {"depth_max_m", c.depth_max_m, 0.5, 60},
      {"walk_start_s", c.walk_start_s, 0, 1e6},
      {"color_row_time_ns", static_cast<double>(c.color_row_time_ns), -SPHC_ROW_TIME_MAX_NS, SPHC_ROW_TIME_MAX_NS},
  };
  for (const auto &n : numbers) {
    if (checkNumber(n.name, n.value, n.low, n.high, message) != SPHC_OK) return SPHC_E_ARGUMENT;
  }
  const struct {
    const char *name;
    uint32_t value;
  } switches[] = {{"color_noise", c.color_noise},
                  {"motion_blur", c.motion_blur},
                  {"exposure_drift", c.exposure_drift},
                  {"ideal_depth", c.ideal_depth},
                  {"raw_depth", c.raw_depth}};
  for (const auto &s : switches) {
    if (checkSwitch(s.name, s.value, message) != SPHC_OK) return SPHC_E_ARGUMENT;
  }
  if (checkWith(c.with, message) != SPHC_OK || checkCameras(c, message) != SPHC_OK) return SPHC_E_ARGUMENT;
  // Frames must come in order of time: colour, depth, colour, depth (or the other way round throughout).
  const double half_period_ns = 0.5e9 / c.frame_rate_hz;
  if (!(std::fabs(static_cast<double>(c.depth_delay_ns)) < half_period_ns)) {
    explain(message, "simulated: depth_delay_ns is %lld; keep it within half a frame period, %.0f ns, either way",
            static_cast<long long>(c.depth_delay_ns), half_period_ns);
    return SPHC_E_ARGUMENT;
  }
  return SPHC_OK;
}

}  // namespace sphc::simulated

sphc_status sphc_simulated_config_init(sphc_simulated_config *config, size_t struct_size) {
  if (config == nullptr) return SPHC_E_ARGUMENT;
  if (struct_size != sizeof *config) return SPHC_E_STRUCT_SIZE;
  sphc_simulated_config defaults;
  std::memset(&defaults, 0, sizeof defaults);
  defaults.struct_size = static_cast<uint32_t>(struct_size);
  defaults.frame_count = 960;
  defaults.seed = 1;
  defaults.walk_seed = 1;
  defaults.frame_rate_hz = 30;
  defaults.lap_s = 16;
  defaults.start_time_ns = 1000000000;
  defaults.depth_delay_ns = 4000000;
  defaults.color_noise = 1;
  defaults.motion_blur = 1;
  defaults.exposure_drift = 1;
  defaults.exposure_s = 0.008;
  defaults.depth_scale = 1.001;
  defaults.depth_offset_m = 0.001;
  defaults.depth_wiggle_m = 0.0015;
  defaults.depth_sigma_m = 0.0013;
  defaults.depth_sigma_per_m2 = 0.0007;
  defaults.depth_max_m = 6;
  *config = defaults;
  return SPHC_OK;
}
