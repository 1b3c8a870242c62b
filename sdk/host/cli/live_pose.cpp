#include "host/cli/live_pose.h"

#include <cstdio>
#include <spherecloud/spherecloud.hpp>

#include "host/report/fault_words.h"
#include "host/report/hint_words.h"
#include "host/report/run.h"

namespace sphc::host {

std::string livePoseText(const sphc_localizer_result &result, const std::vector<std::string> &maps) {
  if (result.faults) return "FAULT: " + faultNames(result.faults);
  if (result.outcome != SPHC_OUTCOME_LOCALIZED)
    return result.hints ? "no pose, " + hintNames(result.hints) : "no pose";
  const sphc_rigid pose = spherecloud::inverse(result.camera_from_map);
  char place[64], confidence[32];
  std::snprintf(place, sizeof place, "%+.2f %+.2f %+.2f m", pose.t_m[0], pose.t_m[1], pose.t_m[2]);
  std::snprintf(confidence, sizeof confidence, ", confidence %.2f", result.confidence);
  return std::string(place) + confidence + (maps.size() > 1 ? " in " + maps.at(result.map_id) : "");
}

std::string liveLine(const sphc_localizer_result &result, const std::vector<std::string> &maps,
                     const LiveNumbers &numbers) {
  char rates[96], effort[64];
  std::snprintf(rates, sizeof rates, "%-12s in %.0f+%.0f out %.0f Hz lost %llu | ", stateName(result.state),
                numbers.color_hz, numbers.depth_hz, numbers.poses_hz,
                static_cast<unsigned long long>(numbers.lost));
  std::snprintf(effort, sizeof effort, " | %u inliers, %.1f ms", result.inliers, numbers.ms);
  return rates + livePoseText(result, maps) + effort;
}

}  // namespace sphc::host
