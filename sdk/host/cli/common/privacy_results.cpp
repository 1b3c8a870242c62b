#include "host/cli/common/privacy_results.h"

#include <algorithm>

#include "host/report/results.h"

namespace sphc::host {

const char kPrivacyHead[] = "attack,map,strategy,eta,variant,metric,value";

void updatePrivacyResults(const std::string &path, const std::vector<PrivacyRow> &rows) {
  std::vector<std::string> keys;  // in the rows' order
  for (const PrivacyRow &row : rows)
    if (std::find(keys.begin(), keys.end(), keyOf(row)) == keys.end()) keys.push_back(keyOf(row));
  for (const std::string &key : keys) replacePrivacyResults(path, key, rows);
}

void replacePrivacyResults(const std::string &path, const std::string &key, const std::vector<PrivacyRow> &rows) {
  std::vector<std::string> lines;
  for (const PrivacyRow &row : rows)
    if (keyOf(row) == key) lines.push_back(lineOf(row));
  replaceRows(path, kPrivacyHead, key, lines);
}

}  // namespace sphc::host
