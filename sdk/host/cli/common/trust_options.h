// How a subcommand is told whose maps it may use.
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "host/cli/common/file_use.h"
#include "host/signing/signed_map.h"

namespace sphc::host {

struct TrustOptions {
  std::vector<std::string> keys;  // files
  uint64_t least_release = 0;
};

// Of a subcommand that may use unsigned maps, while no key is named.
void addTrustOptions(CLI::App *app, TrustOptions *options);
void readsTrust(const TrustOptions &options, FileUse *files);
// Throws std::runtime_error with cause and cure.
Trust trustOf(const TrustOptions &options);

}  // namespace sphc::host
