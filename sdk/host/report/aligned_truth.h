// The truth of a run, brought to the worlds of maps that were made without poses.
#pragma once
#include "host/report/run.h"

namespace sphc::host {

// Moves the truth by the rigid transform that brings it nearest to the localized poses (least squares over the
// cameras' places and what lies 1 m along their axes, without poses that stay far off), and judges the frames anew.
// Each map may have a world of its own, so each has a transform of its own, from its own answers; a frame without
// an answer goes with an answer before it.  Run::aligned_frames says how many poses the transforms rest on.  The
// maps that come back have too few poses with truth, fewer than three: their answers' truth lies in an unknown
// world, and is dropped.
std::vector<uint32_t> alignTruth(Run *run);

}  // namespace sphc::host
