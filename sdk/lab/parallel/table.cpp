#include "lab/parallel/table.h"

#include <cstdio>

namespace sphc::host {

std::string parallelText(const std::vector<ParallelRow> &rows) {
  std::string text =
      "threads  frames  same bytes   frame ms  features  match   x faster: frame  features  match   scratch B\n";
  for (const ParallelRow &row : rows) {
    const FrameTimes &one = rows[0].times, &own = row.times;
    char line[256];
    std::snprintf(line, sizeof line, "%7u %7u %11u %10.2f %9.2f %6.2f %17.2f %9.2f %6.2f %11llu\n", row.threads,
                  row.frames, row.same, own.total_ms, own.features_ms, own.match_ms, one.total_ms / own.total_ms,
                  one.features_ms / own.features_ms, one.match_ms / own.match_ms,
                  static_cast<unsigned long long>(row.scratch_bytes));
    text += line;
  }
  return text;
}

nlohmann::ordered_json parallelJson(const std::vector<ParallelRow> &rows) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const ParallelRow &row : rows) {
    const FrameTimes &one = rows[0].times, &own = row.times;
    json.push_back({{"threads", row.threads},
                    {"frames", row.frames},
                    {"same_bytes", row.same},
                    {"frame_ms_median", own.total_ms},
                    {"times_faster", one.total_ms / own.total_ms},
                    {"features_times_faster", one.features_ms / own.features_ms},
                    {"match_times_faster", one.match_ms / own.match_ms},
                    {"scratch_bytes", row.scratch_bytes}});
  }
  return json;
}

}  // namespace sphc::host
