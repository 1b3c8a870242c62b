// The subcommands of spherecloud, one file each.
#pragma once
#include "host/cli/common/command.h"

namespace sphc::host {

Command adviseCommand(CLI::App *root);
Command auditCommand(CLI::App *root);
Command buildCommand(CLI::App *root);
Command calibrationCommand(CLI::App *root);
Command convertCommand(CLI::App *root);
Command decryptCommand(CLI::App *root);
Command devicesCommand(CLI::App *root);
Command doctorCommand(CLI::App *root);
Command encryptCommand(CLI::App *root);
Command guideCommand(CLI::App *root);
Command infoCommand(CLI::App *root);
Command inspectCommand(CLI::App *root);
Command keyCommand(CLI::App *root);
Command liveCommand(CLI::App *root);
Command localizeCommand(CLI::App *root);
Command mapCommand(CLI::App *root);
Command recordCommand(CLI::App *root);
Command signCommand(CLI::App *root);
Command simulateCommand(CLI::App *root);
Command verifyCommand(CLI::App *root);

}  // namespace sphc::host
