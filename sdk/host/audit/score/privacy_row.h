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

// Without the line's end.
std::string lineOf(const PrivacyRow &row);

}  // namespace sphc::host
