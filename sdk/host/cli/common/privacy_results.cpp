#include "host/cli/common/privacy_results.h"

#include <map>

#include "host/report/results.h"

namespace sphc::host {

const char kPrivacyHead[] = "attack,map,strategy,eta,variant,metric,value";

void updatePrivacyResults(const std::string &path, const std::vector<PrivacyRow> &rows) {
  std::map<std::string, std::vector<std::string>> groups;
  std::vector<std::string> keys;  // in the rows' order
  for (const PrivacyRow &row : rows) {
    const std::string key = row.attack + "," + row.map + "," + row.strategy + ",";
    if (!groups.count(key)) keys.push_back(key);
    groups[key].push_back(lineOf(row));
  }
  for (const std::string &key : keys) replaceRows(path, kPrivacyHead, key, groups[key]);
}

}  // namespace sphc::host
