// How programs of Windows begin texts.
#pragma once
#include <string_view>

namespace sphc::host {

// UTF-8 without the byte-order mark before it.
inline std::string_view withoutByteOrderMark(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (text.substr(0, kMark.size()) == kMark) text.remove_prefix(kMark.size());
  return text;
}

// By its mark.
inline bool isUtf16(std::string_view text) {
  const std::string_view mark = text.substr(0, 2);
  return mark == "\xFF\xFE" || mark == "\xFE\xFF";
}

}  // namespace sphc::host
