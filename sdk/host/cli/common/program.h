// A program of subcommands: help, wrong use, failure and exit status are alike in each.
#pragma once
#include <vector>

#include "host/cli/common/command.h"

namespace sphc::host {

struct Program {
  const char *name, *about, *footer;
  std::vector<Command> (*declare)(CLI::App *root);
};

// What main returns.  Every exception becomes a message on stderr and a status.
int runProgram(const Program &program, int argc, char **argv);

}  // namespace sphc::host
