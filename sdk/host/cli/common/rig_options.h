// How a subcommand is told of cameras.
#pragma once
#include <CLI/CLI.hpp>

#include "host/live/rig.h"

namespace sphc::host {

void addRigOptions(CLI::App *app, RigOptions *options);
// Throws UsageError where cameras are missing or too many.
void checkRigOptions(const RigOptions &options);
// The file's, else what the cameras know of themselves.  Throws std::runtime_error with the cure.
sphc_rig calibrationOf(const RigOptions &options, const Rig &rig);

}  // namespace sphc::host
