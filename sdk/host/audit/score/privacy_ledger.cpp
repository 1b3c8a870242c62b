#include "host/audit/score/privacy_ledger.h"

#include <cstdio>
#include <fstream>
#include <set>
#include <stdexcept>

namespace sphc::host {
namespace {

const char kHeader[] = "attack,map,strategy,eta,variant,metric,value";

std::string lineOf(const PrivacyRow &row) {
  char eta[32], value[32];
  std::snprintf(eta, sizeof eta, "%.2f", row.eta);
  std::snprintf(value, sizeof value, "%.4g", row.value);
  return row.attack + "," + row.map + "," + row.strategy + "," + eta + "," + row.variant + "," + row.metric + "," +
         value;
}

// Attack, map and strategy.
std::string groupOf(const std::string &line) {
  size_t end = 0;
  for (int commas = 0; end < line.size() && commas < 3; ++end) commas += line[end] == ',';
  return line.substr(0, end);
}

}  // namespace

void updatePrivacyLedger(const std::string &path, const std::vector<PrivacyRow> &rows) {
  std::set<std::string> replaced;
  for (const PrivacyRow &row : rows) replaced.insert(groupOf(lineOf(row)));
  std::vector<std::string> lines = {kHeader};
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);)
    if (line != kHeader && replaced.count(groupOf(line)) == 0) lines.push_back(line);
  in.close();
  for (const PrivacyRow &row : rows) lines.push_back(lineOf(row));
  std::ofstream out(path, std::ios::trunc);
  for (const std::string &line : lines) out << line << "\n";
  out.close();
  if (!out) throw std::runtime_error(path + " cannot be written; is the folder there and the disk not full?");
}

}  // namespace sphc::host
