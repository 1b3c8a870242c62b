#include "text_field.h"

#include <algorithm>
#include <charconv>
#include <cstdio>

namespace sphc::recording {

namespace {

constexpr int64_t kNsPerSecond = 1000000000;
constexpr std::string_view kSpace = " \t\r\n\v\f";

template <typename Number>
bool parseWhole(std::string_view field, Number &value) {
  const char *end = field.data() + field.size();
  const std::from_chars_result result = std::from_chars(field.data(), end, value);
  return result.ec == std::errc() && result.ptr == end;
}

// from_chars knows no plus.
template <typename Number>
bool parseSigned(std::string_view field, Number &value) {
  if (!field.empty() && field[0] == '+') field.remove_prefix(1);
  return parseWhole(field, value);
}

bool isDigit(char c) { return c >= '0' && c <= '9'; }

// "1753" -> 175300000 (+ 1 if the tenth digit says so)
bool parseFraction(std::string_view digits, int64_t &ns) {
  ns = 0;
  for (size_t i = 0; i < digits.size(); ++i)
    if (!isDigit(digits[i])) return false;
  for (size_t i = 0; i < 9; ++i) ns = 10 * ns + (i < digits.size() ? digits[i] - '0' : 0);
  if (digits.size() > 9 && digits[9] >= '5') ++ns;
  return true;
}

// "15", 1 -> "1.5"; zeros stand where there are no digits.
std::string withPoint(std::string digits, int point) {
  if (point < 1) digits.insert(0, static_cast<size_t>(1 - point), '0');
  const size_t whole = static_cast<size_t>(std::max(point, 1));
  if (digits.size() < whole) digits.append(whole - digits.size(), '0');
  return digits.insert(whole, 1, '.');
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  const size_t begin = text.find_first_not_of(kSpace);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kSpace) - begin + 1);
}

std::string_view takeWord(std::string_view &text) {
  const size_t begin = text.find_first_not_of(kSpace);
  if (begin == std::string_view::npos) return text = {};
  const size_t end = std::min(text.find_first_of(kSpace, begin), text.size());
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

bool parseDouble(std::string_view field, double &value) { return parseSigned(field, value); }

bool parseUnsigned(std::string_view field, uint32_t &value) { return parseWhole(field, value); }

std::string withoutExponent(std::string_view field) {
  constexpr int kMost = 400;  // beyond those of a double
  const size_t mark = std::min(field.find_first_of("eE"), field.size());
  std::string digits(field.substr(0, mark));
  int exponent = 0;
  const bool has_exponent = mark < field.size() && parseSigned(field.substr(mark + 1), exponent);
  if (!has_exponent || exponent < -kMost || exponent > kMost) return std::string(field);
  const size_t point = std::min(digits.find('.'), digits.size());
  if (point < digits.size()) digits.erase(point, 1);
  if (digits.empty() || !std::all_of(digits.begin(), digits.end(), isDigit)) return std::string(field);
  return withPoint(digits, static_cast<int>(point) + exponent);
}

bool parseSeconds(std::string_view text, int64_t &time_ns) {
  const std::string plain = withoutExponent(text);
  const std::string_view field = plain;
  const size_t point = std::min(field.find('.'), field.size());
  const std::string_view whole = field.substr(0, point);
  const std::string_view fraction = point < field.size() ? field.substr(point + 1) : std::string_view();
  int64_t seconds = 0;
  int64_t ns = 0;
  if (whole.empty() || !isDigit(whole[0]) || !parseWhole(whole, seconds)) return false;
  if (seconds >= INT64_MAX / kNsPerSecond || !parseFraction(fraction, ns)) return false;
  time_ns = seconds * kNsPerSecond + ns;
  return true;
}

std::string formatSeconds(int64_t time_ns) {
  char text[40];
  std::snprintf(text, sizeof text, "%lld.%09lld", static_cast<long long>(time_ns / kNsPerSecond),
                static_cast<long long>(time_ns % kNsPerSecond));
  return text;
}

std::string formatNumbers(std::initializer_list<double> numbers) {
  std::string line;
  for (const double number : numbers) {
    char text[32];
    const std::to_chars_result end = std::to_chars(text, text + sizeof text, number);
    line.append(line.empty() ? "" : " ").append(text, end.ptr);
  }
  return line;
}

}  // namespace sphc::recording
