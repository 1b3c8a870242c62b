// spherecloud bench releases: what several releases of one place give away.
#pragma once
#include "host/cli/command.h"

namespace sphc::host {

// A subcommand of `bench`.
Command benchReleasesCommand(CLI::App *bench);

}  // namespace sphc::host
