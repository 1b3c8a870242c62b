// Where words go: people read stdout, unless --json gives stdout to a program.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace sphc::host {

class Console {
 public:
  bool json = false;

  // For people, on stdout; silent with --json.
  void say(const std::string &text) const;
  // For people, on stderr; always.
  void warn(const std::string &text) const;
  // For programs, on stdout; only with --json.
  void give(const nlohmann::ordered_json &value) const;
  // The same on one line, at once: one of many.
  void giveLine(const nlohmann::ordered_json &value) const;
};

}  // namespace sphc::host
