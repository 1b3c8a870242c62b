// Points on what moves: people, things that were carried away, the hands and feet of whoever held the camera.  The
// frames that saw such a point are contradicted by others, which see through the place where it was.
#pragma once
#include <vector>

#include "host/import/depth_views.h"
#include "host/import/point_tracks.h"

namespace sphc::host {

// Drops the points that moved while the views were taken.
MovingSummary dropMoving(const DepthViews &views, std::vector<TrackedPoint> *points);

}  // namespace sphc::host
