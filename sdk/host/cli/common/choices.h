// Options whose values have names.
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

namespace sphc::host {

// For transform(): a name becomes its value, which CLI11 then reads as a number; anything else is refused.  CLI11's
// own CheckedTransformer takes those numbers too, and shows them.
template <class Value>
CLI::Validator oneOf(const std::vector<std::pair<std::string, Value>> &choices) {
  const auto take = [choices](std::string &text) {
    std::string names;
    for (const auto &[name, value] : choices) {
      if (text == name) {
        text = std::to_string(static_cast<int>(value));
        return std::string();
      }
      names += (names.empty() ? "" : ", ") + name;
    }
    return "'" + text + "' is unknown; give one of " + names;
  };
  return CLI::Validator(take, "");
}

}  // namespace sphc::host
