#include "lab/worst/table.h"

#include <cstdio>

namespace sphc::host {
namespace {

std::string fixed(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}

}  // namespace

std::string worstText(const std::vector<WorstRow> &rows) {
  std::string text =
      "case                                 frames  times normal: median   worst  times deadline  localized  wrong "
      " "
      "stack KiB\n";
  for (const WorstRow &row : rows) {
    char line[256];
    std::snprintf(line, sizeof line, "%-36s %6u %21.2f %7.2f %15.2f %10u %6u %10.1f\n", row.name.c_str(),
                  row.frames, row.times_normal_median, row.times_normal_worst, row.times_deadline_worst,
                  row.localized, row.wrong, static_cast<double>(row.stack_bytes) / 1024);
    text += line;
  }
  return text;
}

nlohmann::ordered_json worstJson(const std::vector<WorstRow> &rows) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const WorstRow &row : rows)
    json.push_back({{"case", row.name},
                    {"frames", row.frames},
                    {"times_normal_median", fixed(row.times_normal_median)},
                    {"times_normal_worst", fixed(row.times_normal_worst)},
                    {"times_deadline_worst", fixed(row.times_deadline_worst)},
                    {"localized", row.localized},
                    {"wrong", row.wrong},
                    {"keypoints", row.keypoints},
                    {"matches", row.matches},
                    {"iterations", row.iterations},
                    {"stack_bytes", row.stack_bytes},
                    {"state_bytes", row.state_bytes},
                    {"scratch_bytes", row.scratch_bytes}});
  return json;
}

}  // namespace sphc::host
