// Fields of text files, read the same under every locale.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

namespace sphc::recording {

// Takes the first word off `text`; empty when there is none.
std::string_view takeWord(std::string_view &text);

std::string_view trimmed(std::string_view text);

// Whole field or nothing; "nan" and "inf" are numbers here.
bool parseDouble(std::string_view field, double &value);
bool parseUnsigned(std::string_view field, uint32_t &value);

// The same number without an exponent, as in "1.5e+03", which numpy and evo write; other text as it is.
std::string withoutExponent(std::string_view field);

// Decimal seconds to nanoseconds without a float between them; digits behind the ninth are rounded.
bool parseSeconds(std::string_view text, int64_t &time_ns);
// Its inverse for times >= 0: nine decimals.
std::string formatSeconds(int64_t time_ns);

// The shortest digits that bring back the same bits, with a space between numbers.
std::string formatNumbers(std::initializer_list<double> numbers);

}  // namespace sphc::recording
