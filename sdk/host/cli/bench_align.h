// spherecloud bench align: depth to colour, beside others who do it.
#pragma once
#include "host/cli/command.h"

namespace sphc::host {

// A subcommand of `bench`.
Command benchAlignCommand(CLI::App *bench);

}  // namespace sphc::host
