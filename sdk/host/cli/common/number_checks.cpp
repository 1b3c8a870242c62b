#include "host/cli/common/number_checks.h"

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <type_traits>

namespace sphc::host {
namespace {

std::string textOf(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

CLI::Validator checkOf(double least, double most, const std::string &wanted) {
  return CLI::Validator(
      [least, most, wanted](const std::string &text) {
        double value = 0;
        const bool in_bounds =
            CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value >= least && value <= most;
        return in_bounds ? std::string() : text + " is not " + wanted;
      },
      "");
}

// `read` sets errno.
template <typename Whole>
CLI::Validator wholeCheck(Whole least, Whole most, Whole (*read)(const char *)) {
  return CLI::Validator(
      [least, most, read](std::string &text) {
        const bool has_sign = std::is_signed_v<Whole> && text.rfind('-', 0) == 0;
        const std::string digits = text.substr(has_sign ? 1 : 0);
        const bool has_digits_alone =
            !digits.empty() && digits.find_first_not_of("0123456789") == std::string::npos;
        errno = 0;
        const Whole value = read(text.c_str());
        if (!has_digits_alone || value < least || value > most || errno != 0)
          return text + " is not a whole number from " + std::to_string(least) + " to " + std::to_string(most);
        text = std::to_string(value);
        return std::string();
      },
      "");
}

}  // namespace

CLI::Validator between(double least, double most) {
  return checkOf(least, most, "a number from " + textOf(least) + " to " + textOf(most));
}

CLI::Validator notNegative() { return checkOf(0, std::numeric_limits<double>::max(), "a number from 0 on"); }

CLI::Validator wholeFrom(uint64_t least, uint64_t most) {
  return wholeCheck<uint64_t>(least, most,
                              [](const char *text) -> uint64_t { return std::strtoull(text, nullptr, 10); });
}

CLI::Validator wholeBetween(int64_t least, int64_t most) {
  return wholeCheck<int64_t>(least, most,
                             [](const char *text) -> int64_t { return std::strtoll(text, nullptr, 10); });
}

}  // namespace sphc::host
