#include "host/cli/live_pose.h"

#include <cstdio>
#include <spherecloud/spherecloud.hpp>

#include "host/report/fault_words.h"
#include "host/report/hint_words.h"

namespace sphc::host {

std::string livePoseText(const sphc_localizer_result &result, const std::vector<std::string> &maps) {
  if (result.faults) return "FAULT: " + faultNames(result.faults);
  if (result.outcome != SPHC_OUTCOME_LOCALIZED)
    return result.hints ? "no pose, " + firstHint(result.hints) : "no pose";
  const sphc_rigid pose = spherecloud::inverse(result.camera_from_map);
  char place[64], confidence[32];
  std::snprintf(place, sizeof place, "%+.2f %+.2f %+.2f m", pose.t_m[0], pose.t_m[1], pose.t_m[2]);
  std::snprintf(confidence, sizeof confidence, ", confidence %.2f", result.confidence);
  return place + (maps.size() > 1 ? " in " + maps.at(result.map_id) : "") + confidence;
}

}  // namespace sphc::host
