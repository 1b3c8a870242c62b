#include "host/cli/map_outcome.h"

#include <algorithm>

namespace sphc::host {

uint32_t MappedRecording::framesMapped() const { return static_cast<uint32_t>(placedCount(poses)); }

recording::PoseTrack MappedRecording::path() const {
  recording::PoseTrack path;
  for (uint32_t i = 0; i < poses.size(); ++i)
    if (poses[i]) path.add(reader->colorOf(i).time_ns, rigidToC(*poses[i]));
  return path;
}

bool MapOutcome::isApart() const {
  return !stretches.apart.empty() ||
         std::any_of(recordings.begin(), recordings.end(), [](const auto &r) { return r.framesMapped() == 0; });
}

const char *toldWord(const MapOutcome &outcome) {
  return outcome.use == PoseUse::kOdometry ? "steps of the odometry" : "poses";
}

}  // namespace sphc::host
