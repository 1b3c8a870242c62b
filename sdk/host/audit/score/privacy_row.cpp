#include "host/audit/score/privacy_row.h"

#include <cstdio>

namespace sphc::host {

std::string lineOf(const PrivacyRow &row) {
  char eta[32], value[32];
  std::snprintf(eta, sizeof eta, "%.2f", row.eta);
  std::snprintf(value, sizeof value, "%.4g", row.value);
  return row.attack + "," + row.map + "," + row.strategy + "," + eta + "," + row.variant + "," + row.metric + "," +
         value;
}

}  // namespace sphc::host
