// How a subcommand is told of light: what a camera sees and when its rows do, and what of its own a depth sensor
// must have got back.
#pragma once
#include <CLI/CLI.hpp>
#include <string>

#include "spherecloud/spherecloud.h"

namespace sphc::host {

CLI::Option *addBandOption(CLI::App *app, sphc_band *band, const char *text);
CLI::Option *addAmplitudeOption(CLI::App *app, uint32_t *amplitude_min);
// `behind`: what else is to be said of it.
CLI::Option *addRowTimeOption(CLI::App *app, int64_t *row_time_ns, const std::string &behind);

}  // namespace sphc::host
