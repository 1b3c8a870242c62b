#include "host/cameras/number_text.h"

#include <charconv>
#include <cstdio>

namespace sphc::host {

std::string numberText(double value) {
  char buffer[32];
  std::string text(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
  if (text.find('.') == std::string::npos) text.insert(std::min(text.find('e'), text.size()), ".0");
  return text;
}

std::string briefText(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string numbersText(const std::vector<double> &values, const char *between) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : between) + numberText(value);
  return text;
}

}  // namespace sphc::host
