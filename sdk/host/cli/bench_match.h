// spherecloud bench match: matchers on maps of several sizes.
#pragma once
#include "host/cli/command.h"

namespace sphc::host {

// A subcommand of `bench`.
Command benchMatchCommand(CLI::App *bench);

}  // namespace sphc::host
