// How calibration files are refused: "file: key: cause; cure".
#pragma once
#include <stdexcept>
#include <string>
#include <string_view>

namespace sphc::host {

[[noreturn]] inline void refuse(const std::string &file, const std::string &key, const std::string &why) {
  throw std::runtime_error(file + ": " + key + ": " + why);
}

// What a hostile file says, short and printable.
inline std::string shown(std::string_view text) {
  std::string result;
  for (const char c : text.substr(0, 40)) result += c >= ' ' && c <= '~' ? c : '?';
  return "'" + result + "'";
}

}  // namespace sphc::host
