// spherecloud bench frame: whole frames, ours beside package peers.
#pragma once
#include "host/cli/command.h"

namespace sphc::host {

// A subcommand of `bench`.
Command benchFrameCommand(CLI::App *bench);

}  // namespace sphc::host
