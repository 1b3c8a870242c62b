#include "host/audit/score/privacy_row.h"

#include <cstdio>

namespace sphc::host {

std::string lineOf(const PrivacyRow &row) {
  char eta[32], value[32];
  std::snprintf(eta, sizeof eta, "%.2f", row.eta);
  std::snprintf(value, sizeof value, "%.4g", row.value);
  // RFC 4180; no name has a quote in it.
  const bool has_comma = row.variant.find(',') != std::string::npos;
  const std::string variant = has_comma ? '"' + row.variant + '"' : row.variant;
  return row.attack + "," + row.map + "," + row.strategy + "," + eta + "," + variant + "," + row.metric + "," +
         value;
}

}  // namespace sphc::host
