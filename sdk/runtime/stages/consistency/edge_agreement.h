// Do edges of depth lie on edges of the image?  Where they do not, the two show different things, or the
// calibration is another's.
#pragma once
#include "runtime/geometry/camera.h"
#include "runtime/geometry/rigid.h"
#include "runtime/stages/consistency/depth_edges.h"

namespace sphc {

struct EdgeAgreement {
  // Of a profile across each depth edge, the image's gradient in windows side by side: the middle one is where the
  // calibration puts the edge.
  static constexpr int32_t kWindows = 9, kMiddle = kWindows / 2;
  uint32_t edges = 0;          // that lie on texture, so that they say something
  double rank[kWindows] = {};  // mean rank of each window's strongest gradient among all, 0 to 1; by chance 0.5
  double middle() const { return rank[kMiddle]; }
};

// Of edges of a depth image, by the cameras as they are said to be.
EdgeAgreement agreementOf(Span<const DepthEdge> edges, double depth_unit_m, GrayView gray, const Camera &color,
                          const Camera &depth, const Rigid &color_from_depth);

}  // namespace sphc
