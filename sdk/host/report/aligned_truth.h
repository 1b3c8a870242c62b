// The truth of a run, brought to the world of a map that was made without poses.
#pragma once
#include "host/report/run.h"

namespace sphc::host {

// Moves the truth of all frames by the one rigid transform that brings it nearest to the localized poses (least
// squares over the cameras' places and what lies 1 m along their axes, without poses that stay far off), and judges
// the frames anew.  Run::aligned_frames says how many poses it rests on.  False where fewer than three poses have a
// truth: then it lies in an unknown world, and is dropped.
bool alignTruth(Run *run);

}  // namespace sphc::host
