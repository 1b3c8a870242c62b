#include "pose_track.h"

#include <algorithm>
#include <cmath>

#include "failure.h"

namespace sphc::recording {

namespace {

constexpr double kRotationTolerance = 1e-2;  // of R R^T - I; recordings print six digits or more

double dot4(const double a[4], const double b[4]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]; }

bool isRotation(const double r[3][3]) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double dot = r[i][0] * r[j][0] + r[i][1] * r[j][1] + r[i][2] * r[j][2];
      if (std::fabs(dot - (i == j ? 1.0 : 0.0)) > kRotationTolerance) return false;
    }
  const double determinant = r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1]) -
                             r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0]) +
                             r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0]);
  return determinant > 0.0;
}

// Shepperd's method: divides by the largest of the four components.
void quaternionFromRotation(const double r[3][3], double q[4]) {
  const double trace = r[0][0] + r[1][1] + r[2][2];
  if (trace > 0.0) {
    const double s = 2.0 * std::sqrt(1.0 + trace);
    q[0] = 0.25 * s;
    q[1] = (r[2][1] - r[1][2]) / s;
    q[2] = (r[0][2] - r[2][0]) / s;
    q[3] = (r[1][0] - r[0][1]) / s;
    return;
  }
  int i = r[1][1] > r[0][0] ? 1 : 0;
  if (r[2][2] > r[i][i]) i = 2;
  const int j = (i + 1) % 3;
  const int k = (i + 2) % 3;
  const double s = 2.0 * std::sqrt(1.0 + r[i][i] - r[j][j] - r[k][k]);
  q[0] = (r[k][j] - r[j][k]) / s;
  q[1 + i] = 0.25 * s;
  q[1 + j] = (r[j][i] + r[i][j]) / s;
  q[1 + k] = (r[k][i] + r[i][k]) / s;
}

}  // namespace

void PoseTrack::add(int64_t time_ns, const sphc_rigid &world_from_camera) {
  if (!poses_.empty() && poses_.back().time_ns == time_ns) return;
  poses_.push_back({time_ns, world_from_camera});
}

bool PoseTrack::at(int64_t time_ns, int64_t gap_ns, sphc_rigid &world_from_camera) const {
  const auto after = std::lower_bound(poses_.begin(), poses_.end(), time_ns,
                                      [](const TimedPose &pose, int64_t time) { return pose.time_ns < time; });
  if (after == poses_.end()) return false;
  if (after->time_ns == time_ns) {
    world_from_camera = after->pose;
    return true;
  }
  if (after == poses_.begin()) return false;
  const auto before = after - 1;
  if (after->time_ns - before->time_ns > gap_ns) return false;
  const double s =
      static_cast<double>(time_ns - before->time_ns) / static_cast<double>(after->time_ns - before->time_ns);
  world_from_camera = interpolate(before->pose, after->pose, s);
  return true;
}

sphc_rigid interpolate(const sphc_rigid &from, const sphc_rigid &to, double s) {
  double cosine = dot4(from.q_wxyz, to.q_wxyz);
  const double sign = cosine < 0.0 ? -1.0 : 1.0;  // q and -q are one rotation: take the nearer
  cosine *= sign;
  double a = 1.0 - s;
  double b = s;
  if (cosine < 0.999999) {  // nearer than 3 mrad the straight line is as good and does not divide by 0
    const double angle = std::acos(cosine);
    a = std::sin((1.0 - s) * angle) / std::sin(angle);
    b = std::sin(s * angle) / std::sin(angle);
  }
  sphc_rigid pose;
  for (int i = 0; i < 4; ++i) pose.q_wxyz[i] = a * from.q_wxyz[i] + sign * b * to.q_wxyz[i];
  for (int i = 0; i < 3; ++i) pose.t_m[i] = (1.0 - s) * from.t_m[i] + s * to.t_m[i];
  normalizeQuaternion(pose.q_wxyz, 1.0);
  return pose;
}

bool isFinite(const sphc_rigid &pose) {
  const auto finite = [](double x) { return std::isfinite(x); };
  return std::all_of(pose.q_wxyz, pose.q_wxyz + 4, finite) && std::all_of(pose.t_m, pose.t_m + 3, finite);
}

bool normalizeQuaternion(double q_wxyz[4], double tolerance) {
  const double norm = std::sqrt(dot4(q_wxyz, q_wxyz));
  if (!(std::fabs(norm - 1.0) <= tolerance) || norm == 0.0) return false;
  // One that is unit to rounding keeps its bits, so that writing and reading does not wander.
  if (std::fabs(norm - 1.0) > 1e-15)
    for (int i = 0; i < 4; ++i) q_wxyz[i] /= norm;
  return true;
}

sphc_rigid checkedPose(const sphc_rigid &pose) {
  sphc_rigid checked = pose;
  if (!isFinite(checked)) throw Failure(SPHC_E_ARGUMENT, "pose: not finite; leave out frames that have none");
  if (!normalizeQuaternion(checked.q_wxyz, 1e-3))
    throw Failure(SPHC_E_ARGUMENT, "pose: q_wxyz is not of unit length; divide by its length");
  return checked;
}

bool rigidFromMatrix(const double rows[12], sphc_rigid &pose) {
  if (!std::all_of(rows, rows + 12, [](double x) { return std::isfinite(x); })) return false;
  double rotation[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) rotation[i][j] = rows[4 * i + j];
  if (!isRotation(rotation)) return false;
  quaternionFromRotation(rotation, pose.q_wxyz);
  for (int i = 0; i < 3; ++i) pose.t_m[i] = rows[4 * i + 3];
  return normalizeQuaternion(pose.q_wxyz, 0.1);
}

}  // namespace sphc::recording
