// spherecloud bench map: maps of wanted sizes, to measure with.
#pragma once
#include "host/cli/command.h"

namespace sphc::host {

// A subcommand of `bench`.
Command benchMapCommand(CLI::App *bench);

}  // namespace sphc::host
