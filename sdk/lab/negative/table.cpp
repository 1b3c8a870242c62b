#include "lab/negative/table.h"

#include <cmath>
#include <cstdio>

namespace sphc::host {
namespace {

// "DEPTH_RANGE DEPTH_SCALE".
std::string namesOf(uint32_t faults) {
  const std::string prefix = "SPHC_FAULT_";
  std::string names;
  for (uint32_t bit = 1; bit; bit <<= 1)
    if (faults & bit)
      names += (names.empty() ? "" : " ") + std::string(sphc_localizer_fault_name(bit)).substr(prefix.size());
  return names;
}

}  // namespace

std::string negativeText(const std::vector<NegativeRow> &rows) {
  std::string text =
      "fault                               mode      tried  accepted  wrong  sure  named  sequences\n";
  for (const NegativeRow &row : rows) {
    char line[256];
    std::snprintf(line, sizeof line, "%-35s %-8s %6u %9u %6u %5u %6u  %u of %u  %s\n", row.fault.c_str(),
                  row.mode.c_str(), row.tried, row.accepted, row.wrong, row.wrong_sure, row.named,
                  row.sequences_named, row.sequences, namesOf(row.seen).c_str());
    text += line;
  }
  return text;
}

nlohmann::ordered_json negativeJson(const std::vector<NegativeRow> &rows) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const NegativeRow &row : rows)
    json.push_back({{"fault", row.fault},
                    {"mode", row.mode},
                    {"tried", row.tried},
                    {"accepted", row.accepted},
                    {"wrong", row.wrong},
                    {"wrong_sure", row.wrong_sure},
                    {"worst_m", std::isfinite(row.worst_m) ? nlohmann::ordered_json(row.worst_m) : nullptr},
                    {"worst_deg", row.worst_deg},
                    {"named", row.named},
                    {"sequences", row.sequences},
                    {"sequences_named", row.sequences_named},
                    {"seen", namesOf(row.seen)}});
  return json;
}

}  // namespace sphc::host
