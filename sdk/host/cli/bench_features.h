// spherecloud bench features: keypoint extractors side by side.
#pragma once
#include "host/cli/command.h"

namespace sphc::host {

// A subcommand of `bench`.
Command benchFeaturesCommand(CLI::App *bench);

}  // namespace sphc::host
