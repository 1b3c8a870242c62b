// spherecloud bench confidence: is the confidence what it says?
#pragma once
#include "host/cli/command.h"

namespace sphc::host {

// A subcommand of `bench`.
Command benchConfidenceCommand(CLI::App *bench);

}  // namespace sphc::host
