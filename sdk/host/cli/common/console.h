// Where words go: people read stdout, unless --json gives stdout to a program.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace sphc::host {

class Console {
 public:
  bool json = false;

  // For people, on stdout; silent with --json.  This, give and giveLine throw std::runtime_error when stdout cannot
  // be written.
  void say(const std::string &text) const;
  // For people, on stderr; always.
  void warn(const std::string &text) const;
  // For programs, on stdout; only with --json.
  void give(const nlohmann::ordered_json &value) const;
  // The same on one line: one of many.
  void giveLine(const nlohmann::ordered_json &value) const;
  // Throws std::runtime_error when not all that was said could be written.
  static void checkOutput();

 private:
  void put(const std::string &line) const;
};

}  // namespace sphc::host
