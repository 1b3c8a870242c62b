// tests/pipeline/privacy.csv: one figure of one attack a row.
#pragma once
#include <string>
#include <vector>

namespace sphc::host {

struct PrivacyRow {
  std::string attack, map, strategy;
  double eta;
  std::string variant, metric;
  double value;
};

// Replaces the rows of the attacks, maps and strategies that `rows` are of; others stay.  Throws std::runtime_error
// with cause and cure.
void updatePrivacyLedger(const std::string &path, const std::vector<PrivacyRow> &rows);

}  // namespace sphc::host
