// What the library says of its config, in the words of who typed a command.
#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace sphc::host {

// The same text with the command's options in place of fields and parameters that they set: "--depth-min" for
// "config.depth_min_m", "--band" for "config.color_band".  What no option sets keeps its name.
std::string withOptionNames(const std::string &text, const CLI::App &command);

}  // namespace sphc::host
