#include "lab/rig/table.h"

#include <cstdio>

#include "host/report/statistics.h"

namespace sphc::host {
namespace {

const char *nameOf(RigTof tof) {
  switch (tof) {
    case RigTof::kWide:
      return "wide";
    case RigTof::kAhead:
      return "ahead";
    case RigTof::kAheadAndLeft:
      return "ahead and left";
  }
  return "";
}

}  // namespace

std::string rigText(const std::vector<RigRow> &rows) {
  std::string text =
      "view  cameras  tof             frames  localized  right  wrong  mm (median)  features ms  frame ms\n";
  for (const RigRow &row : rows) {
    char line[160];
    std::snprintf(line, sizeof line, "%-5s %7u  %-14s %7u %10u %6u %6u %12.1f %12.2f %9.2f\n", row.view.c_str(),
                  row.setup.cameras, nameOf(row.setup.tof), row.frames, row.localized, row.right, row.wrong,
                  percentile(row.errors_mm, 0.5), percentile(row.features_us, 0.5) / 1e3,
                  percentile(row.frame_us, 0.5) / 1e3);
    text += line;
  }
  return text;
}

nlohmann::ordered_json rigJson(const std::vector<RigRow> &rows) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const RigRow &row : rows)
    json.push_back({{"view", row.view},
                    {"cameras", row.setup.cameras},
                    {"tof", nameOf(row.setup.tof)},
                    {"frames", row.frames},
                    {"localized", row.localized},
                    {"right", row.right},
                    {"wrong", row.wrong},
                    {"errors_mm", row.errors_mm},
                    {"features_us", row.features_us},
                    {"frame_us", row.frame_us}});
  return json;
}

}  // namespace sphc::host
