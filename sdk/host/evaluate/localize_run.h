// A recording through the localizer, by the C interface alone, as a device would do it.
#pragma once
#include <functional>
#include <vector>

#include "host/evaluate/kept_observations.h"
#include "host/evaluate/map_file.h"
#include "host/evaluate/parameters.h"
#include "host/recording/recording_reader.h"
#include "host/report/run.h"

namespace sphc::host {

// Of frames that are further apart tracking knows no motion between them, by odometry either.
constexpr double kLongestStepS = 0.25;

using FrameDone = std::function<void(uint32_t done, uint32_t total)>;

struct LocalizeInput {
  recording::RecordingReader *reader = nullptr;
  std::function<bool(uint32_t index)> takes_part = {};  // of its frames; empty: all
  std::vector<MapFile> maps;
  sphc_localizer_config config = {};  // cameras already set
  Parameters parameters;
  // Where each map's origin lies in the recording's world; empty: poses stay in their map's frame, without truth.
  std::vector<std::array<double, 3>> centres_in_world_m;
  uint32_t deadline_us = 0;                  // of each frame; 0: none
  bool play_odometry = false;                // the recording's own poses, each step disturbed
  KeptObservations *observations = nullptr;  // where those of run->frames go; null: they are not wanted
};

// Rig and clock into a config whose other fields stay.
void setCameras(const sphc_rig &rig, sphc_localizer_config *config);
// The maps' ids count from 0.  Throws std::runtime_error with cause and cure.
spherecloud::Localizer makeLocalizer(const sphc_localizer_config &config, const std::vector<MapFile> &maps,
                                     const Parameters &parameters = {});
std::vector<Setting> describeConfig(const sphc_localizer_config &config, const Parameters &parameters);

// Fills everything of *run that comes from processing.  A frame that cannot be read is told to `unreadable` and
// is one of run->unreadable.  Throws std::runtime_error when the localizer cannot be made or refuses a frame.
void localizeFrames(const LocalizeInput &input, const FrameDone &frame_done,
                    const std::function<void(const std::string &)> &unreadable, Run *run);

}  // namespace sphc::host
