// spherecloud bench recording: what recording costs and how small it is.
#pragma once
#include "host/cli/command.h"

namespace sphc::host {

// A subcommand of `bench`.
Command benchRecordingCommand(CLI::App *bench);

}  // namespace sphc::host
