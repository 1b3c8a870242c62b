// The lens model Rational6KT of some Azure Kinects.
#pragma once
#include "host/cameras/part.h"

namespace sphc::host {

// An inexact camera's numbers are those of its own model; the nearest camera of OpenCV's takes their place.
CalibrationPart withNearestCameras(CalibrationPart part);

}  // namespace sphc::host
