// Do the matches of a pose agree better if the colour camera has another focal length than it was said to have?
// An image that was cropped or scaled, the calibration of another camera, and what is no depth at all show so.
#pragma once
#include "runtime/base/deadline.h"
#include "runtime/base/span.h"
#include "runtime/types/correspondence.h"
#include "runtime/types/estimate.h"

namespace sphc {

// By how much x and y of what the colour camera sees would have to be longer, at the same depth: the stated focal
// length over the one that the matches agree with, less 1.
struct FocalScale {
  double off = 0;
  double sigma = 1e3;  // of it; this large where nothing is known

  bool isBeyond(double sigmas) const { return absOf(off) > sigmas * sigma; }
};

// Where the derivatives of a match are taken.  At the foot of its ray their error does not go with the residual's.
// At the measured point it does, so that noise pulls at the scale too, most where no depths differ: less is told of
// the focal length, and more of matches that scatter.
enum class FocalDerivatives : uint8_t { kAtFoot, kAtPoint };

// `depth` is what was known of the sensor before the frame.  Matches without depth, and those of further cameras,
// are taken as they are.  A step of Gauss-Newton on pose, depth bias and scale (Rao's score test, 1948) is all
// where it ends within `doubtful_sigmas`; else it is followed to the optimum.  Unknown where the deadline passes
// before.
FocalScale focalScaleOf(Span<const Correspondence> correspondences, const Estimate &estimate,
                        const DepthCalibration &depth, FocalDerivatives derivatives, double doubtful_sigmas,
                        const Deadline &deadline = {});

}  // namespace sphc
