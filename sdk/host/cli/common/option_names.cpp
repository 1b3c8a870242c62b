#include "host/cli/common/option_names.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <regex>
#include <set>

#include "host/report/run.h"

namespace sphc::host {
namespace {

bool isUnit(const std::string &word) {
  static const std::set<std::string> units = {"m", "m2", "px", "rad", "deg", "ns", "us", "ms", "s", "hz"};
  return units.count(word) > 0;
}

// An option has the name of its field, whole or without the unit behind it or the first word: depth_min_m is
// --depth-min, color_band is --band.  "" where the command has none.
std::string optionOf(std::string field, const CLI::App &command) {
  std::transform(field.begin(), field.end(), field.begin(), [](unsigned char c) { return std::tolower(c); });
  std::replace(field.begin(), field.end(), '_', '-');
  const size_t first = field.find('-'), last = field.rfind('-');
  const bool has_unit = last != std::string::npos && isUnit(field.substr(last + 1));
  const std::string without_unit = has_unit ? field.substr(0, last) : field;
  const std::string without_first = first == std::string::npos ? field : field.substr(first + 1);
  for (const std::string &name : {field, without_unit, without_first})
    if (command.get_option_no_throw("--" + name)) return "--" + name;
  return "";
}

}  // namespace

std::string withOptionNames(const std::string &text, const CLI::App &command) {
  static const std::regex named("config\\.([a-z0-9_]+)|SPHC_PARAMETER_([A-Z_]+)");
  std::string result = text;
  for (std::sregex_iterator it(text.begin(), text.end(), named), end; it != end; ++it) {
    const std::string field = (*it)[1].matched ? (*it)[1] : (*it)[2];
    const std::string option = optionOf(field, command);
    if (option.empty()) continue;
    // Named again further on, it often has no "config." in front.
    result = std::regex_replace(result, std::regex("\\b(config\\.|SPHC_PARAMETER_)?" + field + "\\b"), option);
  }
  if (command.get_option_no_throw("--band"))
    for (sphc_band band : {SPHC_BAND_VISIBLE, SPHC_BAND_INFRARED})
      result = std::regex_replace(result, std::regex(sphc_band_name(band)), bandName(band));
  return result;
}

}  // namespace sphc::host
