// Bytes that are written as hexadecimal digits.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace sphc::test {

inline std::vector<uint8_t> bytesOfHex(const std::string &text) {
  std::vector<uint8_t> bytes;
  for (size_t i = 0; i + 1 < text.size(); i += 2)
    bytes.push_back(static_cast<uint8_t>(std::stoi(text.substr(i, 2), nullptr, 16)));
  return bytes;
}

}  // namespace sphc::test
