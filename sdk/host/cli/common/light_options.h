// How a subcommand is told of light: what a camera sees, and what of its own a depth sensor must have got back.
#pragma once
#include <CLI/CLI.hpp>

#include "spherecloud/spherecloud.h"

namespace sphc::host {

CLI::Option *addBandOption(CLI::App *app, sphc_band *band, const char *text);
CLI::Option *addAmplitudeOption(CLI::App *app, uint32_t *amplitude_min);

}  // namespace sphc::host
