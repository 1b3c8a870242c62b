// Depth images of a room, by casting rays: a box seen from within, and boxes that stand in it.
#pragma once
#include <vector>

#include "host/import/depth_views.h"
#include "host/import/point_tracks.h"

namespace sphc::host {

struct Box {
  Vector3 low_m, high_m;
};

constexpr int32_t kViewWidth = 160, kViewHeight = 120;
sphc_rig depthRig();

// y down, z ahead: a room of 6 x 2.6 x 8 m, its floor 1.5 m below the origin.
struct RoomView {
  RoomView(const Rigid &world_from_camera, const std::vector<Box> &things);

  Rigid world_from_camera;
  std::vector<uint16_t> depth_mm;

  ImageView<uint16_t> image() const { return {depth_mm.data(), kViewWidth, kViewHeight, kViewWidth}; }
  Vector3 inCamera(int32_t column, int32_t row) const;
};

// Where the camera looks along z, turned about the vertical.
Rigid standing(const Vector3 &position_m, double turn_rad);
// A point as this view lifts it.
TrackedPoint pointOf(const RoomView &view, int32_t column, int32_t row);

}  // namespace sphc::host
