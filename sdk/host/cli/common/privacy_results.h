// tests/pipeline/privacy.csv: one figure of one attack a row.
#pragma once
#include <string>
#include <vector>

#include "host/audit/score/privacy_row.h"

namespace sphc::host {

extern const char kPrivacyHead[];  // its first line

// Replaces the rows of the attacks, maps and strategies that `rows` are of; others stay.  Throws std::runtime_error
// with cause and cure.
void updatePrivacyResults(const std::string &path, const std::vector<PrivacyRow> &rows);
// The same of one key (keyOf), also where none of `rows` is of it: then no row of it is left.
void replacePrivacyResults(const std::string &path, const std::string &key, const std::vector<PrivacyRow> &rows);

}  // namespace sphc::host
