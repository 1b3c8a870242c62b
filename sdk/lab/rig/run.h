// Frames of a rig, localized by one of its cameras, by two, by three and by all of them, and with other ToF
// cameras.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "host/evaluate/map_file.h"
#include "lab/rig/headset.h"

namespace sphc::host {

struct RigInput {
  const sphc_simulated *room = nullptr;
  const std::vector<MapFile> *maps = nullptr;
  Vector3 centre_in_world_m = Vector3::Zero();
  uint32_t views = 0;  // of each kind, at most
  uint32_t keypoints = 0;
};

struct RigRow {
  std::string view;  // "walk": as the walk looks; "wall": with a bare wall ahead
  RigSetup setup;
  uint32_t frames = 0, localized = 0, right = 0,
           wrong = 0;             // right: within 5 cm and 5 deg; wrong: beyond 25 cm or 10 deg
  std::vector<double> errors_mm;  // of the localized
  std::vector<double> features_us, frame_us;
};

using RigProgress = std::function<void(uint32_t done, uint32_t total)>;
std::vector<RigRow> runRig(const RigInput &input, const RigProgress &progress);

}  // namespace sphc::host
