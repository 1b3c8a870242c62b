#include "lab/predict/table.h"

#include <cstdio>

namespace sphc::host {

std::string predictText(const std::vector<PredictRow> &rows) {
  std::string text =
      "ahead    by        predictions  mm (last pose)    deg (last pose)   68 % in sigmas: shift  turn   95 %: "
      "shift  "
      "turn\n";
  for (const PredictRow &row : rows) {
    char line[256];
    std::snprintf(line, sizeof line, "%5.1f ms %-8s %12u %6.1f (%6.1f) %9.2f (%6.2f) %24.2f %5.2f %13.2f %5.2f\n",
                  static_cast<double>(row.ahead_ns) / 1e6, row.odometry ? "odometry" : "poses", row.predictions,
                  1000 * row.error_m, 1000 * row.still_m, row.error_deg, row.still_deg, row.shift_sigmas,
                  row.turn_sigmas, row.shift_sigmas95, row.turn_sigmas95);
    text += line;
  }
  return text;
}

nlohmann::ordered_json predictJson(const std::vector<PredictRow> &rows) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const PredictRow &row : rows)
    json.push_back({{"ahead_ns", row.ahead_ns},
                    {"odometry", row.odometry},
                    {"predictions", row.predictions},
                    {"error_m", row.error_m},
                    {"error_deg", row.error_deg},
                    {"last_pose_error_m", row.still_m},
                    {"last_pose_error_deg", row.still_deg},
                    {"shift_sigmas_68", row.shift_sigmas},
                    {"turn_sigmas_68", row.turn_sigmas},
                    {"shift_sigmas_95", row.shift_sigmas95},
                    {"turn_sigmas_95", row.turn_sigmas95}});
  return json;
}

}  // namespace sphc::host
