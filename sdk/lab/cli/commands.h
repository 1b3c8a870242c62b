// The subcommands of spherecloud-lab, one file each.
#pragma once
#include "host/cli/common/command.h"

namespace sphc::host {

Command alignCommand(CLI::App *root);
Command compareCommand(CLI::App *root);
Command deadlineCommand(CLI::App *root);
Command featuresCommand(CLI::App *root);
Command frameCommand(CLI::App *root);
Command hintsCommand(CLI::App *root);
Command mapCommand(CLI::App *root);
Command matchCommand(CLI::App *root);
Command negativeCommand(CLI::App *root);
Command parallelCommand(CLI::App *root);
Command poseCommand(CLI::App *root);
Command predictCommand(CLI::App *root);
Command recordingCommand(CLI::App *root);
Command releasesCommand(CLI::App *root);
Command worstCommand(CLI::App *root);
Command rigCommand(CLI::App *root);  // where there is a simulated headset

}  // namespace sphc::host
