// How a subcommand is told of what light a camera sees.
#pragma once
#include <CLI/CLI.hpp>

#include "spherecloud/spherecloud.h"

namespace sphc::host {

CLI::Option *addBandOption(CLI::App *app, sphc_band *band, const char *text);

}  // namespace sphc::host
