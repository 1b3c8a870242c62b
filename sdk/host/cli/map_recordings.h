// From recordings to where their frames were taken from, and the points that they saw, for `spherecloud map`.
#pragma once
#include "host/cli/common/console.h"
#include "host/cli/map_options.h"
#include "host/cli/map_outcome.h"
#include "host/mapping/calibration_fit.h"

namespace sphc::host {

MapOutcome mapRecordings(const MapOptions &options, const Console &console);

struct RefinedCalibration {
  sphc_rig given;  // of all recordings
  CalibrationFit fit;
};

// The calibration that the recordings agree with best.
RefinedCalibration refineCalibration(const MapOptions &options, const Console &console);

}  // namespace sphc::host
