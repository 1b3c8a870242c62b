#include "host/audit/score/privacy_row.h"

#include <cstdio>

namespace sphc::host {
namespace {

// RFC 4180.
std::string field(const std::string &text) {
  if (text.find_first_of(",\"") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace

std::string keyOf(const PrivacyRow &row) {
  return field(row.attack) + "," + field(row.map) + "," + field(row.strategy) + ",";
}

std::string lineOf(const PrivacyRow &row) {
  char eta[32], value[32];
  std::snprintf(eta, sizeof eta, "%.2f", row.eta);
  std::snprintf(value, sizeof value, "%.4g", row.value);
  return keyOf(row) + eta + "," + field(row.variant) + "," + row.metric + "," + value;
}

}  // namespace sphc::host
