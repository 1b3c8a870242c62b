#include "tests/unit/host/import/room_with_things.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/scene.h"

namespace sphc::host {
namespace {

constexpr double kViewFocalPx = 100, kViewUnitM = 0.001;
const Box kWalls = {{-3, -1.1, -4}, {3, 1.5, 4}};

Vector3 viewRay(int32_t column, int32_t row) {
  return {(column + 0.5 - 0.5 * kViewWidth) / kViewFocalPx, (row + 0.5 - 0.5 * kViewHeight) / kViewFocalPx, 1};
}

// Where a ray enters a box and where it leaves it, as multiples of its direction.
void crossBox(const Box &box, const Vector3 &origin, const Vector3 &direction, double *enters, double *leaves) {
  *enters = -std::numeric_limits<double>::infinity();
  *leaves = -*enters;
  for (int i = 0; i < 3; ++i) {
    const double a = (box.low_m[i] - origin[i]) / direction[i], b = (box.high_m[i] - origin[i]) / direction[i];
    *enters = std::max(*enters, std::min(a, b));
    *leaves = std::min(*leaves, std::max(a, b));
  }
}

}  // namespace

sphc_rig depthRig() {
  sphc_rig rig;
  sphc_rig_init(&rig);
  rig.color_camera = rig.depth_camera = test::pinhole(kViewWidth, kViewHeight, kViewFocalPx);
  rig.depth_unit_m = kViewUnitM;
  return rig;
}

RoomView::RoomView(const Rigid &pose, const std::vector<Box> &things) : world_from_camera(pose) {
  for (int32_t row = 0; row < kViewHeight; ++row)
    for (int32_t column = 0; column < kViewWidth; ++column) {
      const Vector3 direction = pose.rotation * viewRay(column, row);
      double enters = 0, nearest = 0;
      crossBox(kWalls, pose.translation_m, direction, &enters, &nearest);
      for (const Box &thing : things) {
        double leaves = 0;
        crossBox(thing, pose.translation_m, direction, &enters, &leaves);
        if (enters > 0 && enters < leaves) nearest = std::min(nearest, enters);
      }
      depth_mm.push_back(static_cast<uint16_t>(std::lround(nearest / kViewUnitM)));
    }
}

Vector3 RoomView::inCamera(int32_t column, int32_t row) const {
  return kViewUnitM * image().row(row)[column] * viewRay(column, row);
}

Rigid standing(const Vector3 &position_m, double turn_rad) {
  return {rotationFromVector(Vector3(0, turn_rad, 0)), position_m};
}

TrackedPoint pointOf(const RoomView &view, int32_t column, int32_t row) {
  TrackedPoint tracked = {};
  tracked.point.position_m = view.world_from_camera * view.inCamera(column, row);
  tracked.point.observations = 1;
  tracked.cameras_m = {view.world_from_camera.translation_m};
  return tracked;
}

}  // namespace sphc::host
