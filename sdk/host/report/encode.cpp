#include "host/report/encode.h"

namespace sphc::host {
namespace {

void replaceAll(std::string *text, const std::string &from, const std::string &to) {
  for (size_t at = text->find(from); at != std::string::npos; at = text->find(from, at + to.size())) {
    text->replace(at, from.size(), to);
  }
}

}  // namespace

std::string base64(const std::vector<uint8_t> &bytes) {
  static const char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t left = bytes.size() - i;
    const uint32_t three = static_cast<uint32_t>(bytes[i]) << 16 |
                           (left > 1 ? static_cast<uint32_t>(bytes[i + 1]) << 8 : 0u) |
                           (left > 2 ? static_cast<uint32_t>(bytes[i + 2]) : 0u);
    text += kDigits[three >> 18];
    text += kDigits[three >> 12 & 63];
    text += left > 1 ? kDigits[three >> 6 & 63] : '=';
    text += left > 2 ? kDigits[three & 63] : '=';
  }
  return text;
}

std::string escapeHtml(const std::string &text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      case '\'':
        safe += "&#39;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

std::string inlineSvg(const std::string &svg, const std::string &prefix) {
  const size_t start = svg.find("<svg");
  std::string text = start == std::string::npos ? svg : svg.substr(start);
  for (const char quote : {'"', '\''}) {
    replaceAll(&text, std::string(" id=") + quote, std::string(" id=") + quote + prefix);
    replaceAll(&text, std::string("href=") + quote + "#", std::string("href=") + quote + "#" + prefix);
  }
  replaceAll(&text, "url(#", "url(#" + prefix);
  return text;
}

}  // namespace sphc::host
