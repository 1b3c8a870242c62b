#include "host/import/rolling_rows.h"

namespace sphc::host {

// The camera moves steadily for as long as rows are exposed.
bool RollingRows::begin(int64_t time_ns, const sphc_rigid &world_from_camera, const Poses &poses) {
  if (!roll()) return true;
  turn_rad_ = shift_m_ = Vector3::Zero();
  const int64_t half_ns = row_time_ns_ * camera_.height() / 2;
  const auto after = [time_ns](int64_t ns) {  // without overflow: a recording has any times
    return static_cast<int64_t>(static_cast<uint64_t>(time_ns) + static_cast<uint64_t>(ns));
  };
  const std::optional<sphc_rigid> at_first = poses(after(-half_ns)), at_last = poses(after(half_ns));
  if (!at_first && !at_last) return false;
  const Rigid world_from_first = rigidFromC(at_first.value_or(world_from_camera)),
              world_from_last = rigidFromC(at_last.value_or(world_from_camera));
  const double rows = 0.5 * camera_.height() * (at_first.has_value() + at_last.has_value());
  const Rigid last_from_first = world_from_last.inverse() * world_from_first;
  turn_rad_ = vectorFromRotation(last_from_first.rotation) / rows;
  shift_m_ = last_from_first.translation_m / rows;
  return true;
}

// As FrontEnd::atMidTime, but of a whole recording's poses; what a map shows lies within an image.
bool RollingRows::toMiddle(const Vector3 &point_m, Vector2 *pixel_px) const {
  const double rows = 0.5 * camera_.height() - pixel_px->y();
  Vector2 middle_px;
  if (!camera_.project(point_m + rows * (turn_rad_.cross(point_m) + shift_m_), &middle_px)) return false;
  if (!(middle_px.x() >= 0 && middle_px.x() < camera_.width() && middle_px.y() >= 0 &&
        middle_px.y() < camera_.height()))
    return false;
  *pixel_px = middle_px;
  return true;
}

}  // namespace sphc::host
