// The subcommands: each declares its options on the root and says what to run when it was the one chosen.
#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <vector>

#include "host/cli/console.h"

namespace sphc::host {

struct Command {
  CLI::App *app = nullptr;
  std::function<int(const Console &)> run;  // gives an ExitCode; throws std::exception with cause and cure
};

Command simulateCommand(CLI::App *root);
Command auditCommand(CLI::App *root);
Command buildCommand(CLI::App *root);
Command adviseCommand(CLI::App *root);
Command localizeCommand(CLI::App *root);
Command compareCommand(CLI::App *root);
Command convertCommand(CLI::App *root);
Command devicesCommand(CLI::App *root);
Command doctorCommand(CLI::App *root);
Command recordCommand(CLI::App *root);
Command liveCommand(CLI::App *root);
Command inspectCommand(CLI::App *root);
Command infoCommand(CLI::App *root);
Command calibrationCommand(CLI::App *root);
std::vector<Command> benchCommands(CLI::App *root);

}  // namespace sphc::host
