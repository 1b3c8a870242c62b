// A recording through the localizer, by the C door alone, as a device would do it.
#pragma once
#include <functional>
#include <optional>

#include "drivers/replay/replay.h"
#include "host/cli/map_file.h"
#include "host/report/run.h"

namespace sphc::host {

using FrameDone = std::function<void(uint32_t done, uint32_t total)>;

struct LocalizeInput {
  sphc_replay *replay = nullptr;
  const MapFile *map = nullptr;
  sphc_config config = {};  // cameras already set
  // Where the map's origin lies in the recording's world; without it poses stay in the map's frame, without truth.
  std::optional<std::array<double, 3>> centre_in_world_m;
  bool keep_observations = false;
};

// Cameras, depth unit and clock into a config whose other fields stay.
void setCameras(const sphc_replay *replay, sphc_config *config);
std::vector<Setting> describeConfig(const sphc_config &config);

// Fills everything of *run that comes from processing.  A frame that cannot be read is told to `unreadable`,
// counted and left out.  Throws std::runtime_error when the localizer cannot be made or refuses a frame.
void localizeFrames(const LocalizeInput &input, const FrameDone &frame_done,
                    const std::function<void(const std::string &)> &unreadable, Run *run);

}  // namespace sphc::host
