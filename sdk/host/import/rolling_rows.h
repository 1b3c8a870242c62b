// Of a rolling shutter: where keypoints would be if all rows had been exposed with the middle one.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>

#include "runtime/geometry/camera.h"
#include "runtime/geometry/rigid.h"
#include "spherecloud/spherecloud.h"

namespace sphc::host {

class RollingRows {
 public:
  using Poses = std::function<std::optional<sphc_rigid>(int64_t time_ns)>;  // world_from_camera

  // `row_time_ns`: from a row's exposure to that of the row below it, either sign.  0: all at once.
  RollingRows(const Camera &camera, int64_t row_time_ns) : camera_(camera), row_time_ns_(row_time_ns) {}

  bool roll() const { return row_time_ns_ != 0; }
  // Before each frame, which has this pose at this time, that of its middle row.  False where rows roll, and no
  // pose is known near the first of them nor near the last: they are then taken for exposed at once.
  bool begin(int64_t time_ns, const sphc_rigid &world_from_camera, const Poses &poses);
  // Takes a pixel there, by the point that is seen in it, metres in the camera's frame.  False where that is out of
  // the image.
  bool toMiddle(const Vector3 &point_m, Vector2 *pixel_px) const;

 private:
  Camera camera_;
  int64_t row_time_ns_;
  // Of points that stand still, in the camera's frame, from row to row: by turn x point + shift.
  Vector3 turn_rad_ = Vector3::Zero(), shift_m_ = Vector3::Zero();
};

}  // namespace sphc::host
