// Numbers of things in sentences.
#pragma once

#include <cstdint>
#include <string>

namespace sphc::host {

// "1 frame", "3 frames".
inline std::string counted(uint64_t count, const std::string &thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

}  // namespace sphc::host
