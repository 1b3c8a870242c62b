#include "lab/deadline/table.h"

#include <cmath>
#include <cstdio>

namespace sphc::host {

std::string deadlineText(const std::vector<DeadlineRow> &rows) {
  std::string text =
      "deadline   frames  in time  median ms  worst ms  right  wrong  cut: features  matches  search  "
      "verification\n";
  for (const DeadlineRow &row : rows) {
    char line[256];
    std::snprintf(line, sizeof line, "%6.2f ms %8u %7.2f%% %10.2f %9.2f %6u %6u %14u %8u %7u %13u\n",
                  row.deadline_us / 1000.0, row.frames, 100.0 * row.in_time / row.frames, row.median_us / 1000,
                  row.worst_us / 1000, row.right, row.wrong, row.features_cut, row.matches_cut, row.search_cut,
                  row.verification_cut);
    text += line;
  }
  return text;
}

nlohmann::ordered_json deadlineJson(const std::vector<DeadlineRow> &rows) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const DeadlineRow &row : rows)
    json.push_back({{"deadline_us", row.deadline_us},
                    {"frames", row.frames},
                    {"in_time", row.in_time},
                    {"median_us", std::round(row.median_us)},
                    {"worst_us", std::round(row.worst_us)},
                    {"right", row.right},
                    {"wrong", row.wrong},
                    {"features_cut", row.features_cut},
                    {"matches_cut", row.matches_cut},
                    {"search_cut", row.search_cut},
                    {"verification_cut", row.verification_cut}});
  return json;
}

}  // namespace sphc::host
