// Numbers as text that every reader of these formats takes back to the same bits.
#pragma once
#include <string>
#include <vector>

namespace sphc::host {

// The shortest decimal that reads back the same, always with a point: YAML 1.1 takes "1e-05" for a word.
std::string numberText(double value);
// Three digits, for people.
std::string briefText(double value);
// "a, b, c"
std::string numbersText(const std::vector<double> &values, const char *between = ", ");

}  // namespace sphc::host
