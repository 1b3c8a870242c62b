// A subcommand: its options are declared on the root; `run` is called when it was the one chosen.
#pragma once
#include <CLI/CLI.hpp>
#include <functional>

#include "host/cli/common/console.h"

namespace sphc::host {

struct Command {
  CLI::App *app = nullptr;
  std::function<int(const Console &)> run;  // gives an ExitCode; throws std::exception with cause and cure
};

}  // namespace sphc::host
