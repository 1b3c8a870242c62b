// What the main of every tool here does: tells how to use it, and why it failed.
#pragma once
#include <exception>
#include <iostream>
#include <string>

namespace sphc::host {

// `usage` begins with the tool's name; `run` throws std::runtime_error.  Returns the status to exit with.
template <typename Run>
int runTool(const std::string &usage, bool fits, Run run) {
  if (!fits) {
    std::cerr << "usage: " << usage << '\n';
    return 2;
  }
  try {
    run();
  } catch (const std::exception &failure) {
    std::cerr << usage.substr(0, usage.find(' ')) << ": " << failure.what() << '\n';
    return 1;
  }
  return 0;
}

}  // namespace sphc::host
