#include "host/cli/common/console.h"

#include <cstdio>

namespace sphc::host {

void Console::say(const std::string &text) const {
  if (json) return;
  std::fputs((text + "\n").c_str(), stdout);
  std::fflush(stdout);  // keeps the order with what goes to stderr
}

void Console::warn(const std::string &text) const { std::fputs((text + "\n").c_str(), stderr); }

void Console::give(const nlohmann::ordered_json &value) const {
  if (json) std::fputs((value.dump(2) + "\n").c_str(), stdout);
}

void Console::giveLine(const nlohmann::ordered_json &value) const {
  if (!json) return;
  std::fputs((value.dump() + "\n").c_str(), stdout);
  std::fflush(stdout);
}

}  // namespace sphc::host
