// What `spherecloud map` is told.
#pragma once
#include <CLI/CLI.hpp>

#include "host/cli/common/point_source.h"
#include "host/mapping/walk_mapper.h"

namespace sphc::host {

struct MapOptions {
  std::vector<std::string> recordings, trajectories, told;  // told: files of poses
  RecordingOptions of_each;                                 // of the recordings
  RgbdImportOptions import;
  PoseTrust trust;
  double sigma_deg = 1, drift_percent = 1, drift_deg = 1;
  sphc_band band = SPHC_BAND_VISIBLE;
  std::string model, refined_calibration;
  uint32_t threads = 0;
  bool score = false, force = false;

  MappingOptions mapping() const;
  // The poses of the recording are not used, but compared.  Those of several are in several worlds.
  bool judgesTold() const { return score && trust.use == PoseUse::kNone && recordings.size() == 1; }
  std::vector<RecordingOptions> all() const;
};

void addMapOptions(CLI::App *app, MapOptions *options);
// Throws a UsageError for what does not go together, and for files that are not to be written.
void checkMapOptions(const CLI::App &app, const MapOptions &options);

}  // namespace sphc::host
