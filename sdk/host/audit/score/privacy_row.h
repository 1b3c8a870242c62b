// One figure of one attack: a row of tests/pipeline/privacy.csv.
#pragma once
#include <string>

namespace sphc::host {

struct PrivacyRow {
  std::string attack, map, strategy;
  double eta;
  std::string variant, metric;
  double value;
};

// What the lines of one attack on one map begin with.
std::string keyOf(const PrivacyRow &row);
// Without the line's end; no text of it has one.
std::string lineOf(const PrivacyRow &row);

}  // namespace sphc::host
