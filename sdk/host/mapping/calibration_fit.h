// The calibration that a walk itself agrees with best.
#pragma once
#include "host/mapping/walk_mapper.h"

namespace sphc::host {

// A calibration to read the walk with, and whether to find the surfaces of its points (FrameReaderOptions).
struct TrialCalibration {
  sphc_rig rig;
  bool surfaces = false;
};
// What it returns is read until the next call.
using ReadTrial = std::function<const Walk &(const TrialCalibration &)>;

struct CalibrationFit {
  sphc_rig calibration;
  size_t frames = 0;                // that had a place, and so took part
  int rounds = 0;                   // that made the walk agree better with itself; 0: the calibration stays
  AdjustmentSummary before, after;  // residuals with the given calibration, and with the fitted one
};

// Reads and maps the walk again and again, until it agrees no better.  Found are focal length and principal point
// of the colour camera and, where depth does not lie on the colour image, how color_from_depth turns and shifts
// across the optical axis; distortion and the depth camera's own lens stay.  What is free and changed in `mapping`
// is set here.  A calibration with which no two frames agree is worse than the one before it.  Throws as `read`
// does, and as mapWalk does of the given calibration.
CalibrationFit fitCalibration(const sphc_rig &given, const ReadTrial &read, const MappingOptions &mapping,
                              const MappingProgress &progress);

}  // namespace sphc::host
