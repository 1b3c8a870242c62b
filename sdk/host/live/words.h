// What drivers tell in numbers, in words.
#pragma once
#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>

namespace sphc::host {

// "3 lost, 1 corrupt": those that are not 0.
inline std::string countsInWords(std::initializer_list<std::pair<const char *, uint64_t>> counts) {
  std::string words;
  for (const auto &[name, count] : counts)
    if (count > 0) words += (words.empty() ? "" : ", ") + std::to_string(count) + " " + name;
  return words;
}

// "YUYV"; the bit that names the big-endian variant of a layout is shown as Linux does: "Y16 -BE".
inline std::string fourccText(uint32_t fourcc) {
  std::string text;
  for (int i = 0; i < 4; ++i) {
    const char letter = static_cast<char>(fourcc >> (8 * i) & 0x7f);
    text += letter >= ' ' && letter <= '~' ? letter : '?';
  }
  return fourcc >> 31 ? text + "-BE" : text;
}

}  // namespace sphc::host
