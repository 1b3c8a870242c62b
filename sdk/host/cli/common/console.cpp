#include "host/cli/common/console.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <stdexcept>

#include "host/report/json.h"

namespace sphc::host {

void Console::say(const std::string &text) const {
  if (!json) put(text);
}

void Console::warn(const std::string &text) const { std::fputs((text + "\n").c_str(), stderr); }

void Console::give(const nlohmann::ordered_json &value) const {
  if (json) put(jsonText(value, 2));
}

void Console::giveLine(const nlohmann::ordered_json &value) const {
  if (json) put(jsonText(value));
}

void Console::put(const std::string &line) const {
  std::fputs((line + "\n").c_str(), stdout);
  checkOutput();
}

// At once: it keeps the order with what goes to stderr, and a disk that is full is seen here.
void Console::checkOutput() {
  std::cout.flush();
  if (std::fflush(stdout) == 0 && !std::ferror(stdout) && std::cout.good()) return;
  throw std::runtime_error(std::string("the output cannot be written: ") + std::strerror(errno) +
                           "; is the disk full, or did the program that reads it end?");
}

}  // namespace sphc::host
