// Points on what moves: people, things that were carried away, the hands and feet of whoever held the camera.  The
// frames that saw such a point are contradicted by others, which see through the place where it was.  Of several
// recordings the later ones are right: what they see through is gone, and what they saw first is new.
#pragma once
#include <vector>

#include "host/import/depth_views.h"
#include "host/import/point_tracks.h"

namespace sphc::host {

// Drops the points that moved while the views were taken, or were gone later.  `views`: of each recording, the
// oldest first; TrackedPoint::recording counts them.
MovingSummary dropMoving(const std::vector<DepthViews> &views, std::vector<TrackedPoint> *points);

}  // namespace sphc::host
