// What an option's number must be.  CLI11's own checks take "nan" for a number in every range, and -1 for the
// largest number without a sign.
#pragma once
#include <CLI/CLI.hpp>
#include <cstdint>

namespace sphc::host {

// Of a decimal number, in both bounds; infinity is in none.
CLI::Validator between(double least, double most);
// From 0 on: seconds, metres.
CLI::Validator notNegative();
// For transform(), of a whole number, as a seed (from 0) or a step (from 1).  Zeros in front, as in names of files,
// go: CLI11 would take the rest for octal.
CLI::Validator wholeFrom(uint64_t least, uint64_t most = UINT64_MAX);
// The same, of either sign.
CLI::Validator wholeBetween(int64_t least, int64_t most);

}  // namespace sphc::host
