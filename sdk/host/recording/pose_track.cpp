#include "pose_track.h"

#include <algorithm>
#include <cmath>

#include "failure.h"
#include "host/cameras/rigid_matrix.h"

namespace sphc::recording {

namespace {

// How far a time since 1970 may move when somebody kept it as a double of seconds, or printed six decimals of it.
constexpr uint64_t kSameTimeNs = 1000;

// Without overflow, whatever times were asked for.
uint64_t timeBetween(int64_t early_ns, int64_t late_ns) {
  return static_cast<uint64_t>(late_ns) - static_cast<uint64_t>(early_ns);
}

double dot4(const double a[4], const double b[4]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]; }

}  // namespace

void PoseTrack::add(int64_t time_ns, const sphc_rigid &world_from_camera) {
  if (!poses_.empty() && poses_.back().time_ns == time_ns) return;
  poses_.push_back({time_ns, world_from_camera});
}

std::optional<sphc_rigid> PoseTrack::at(int64_t time_ns, int64_t gap_ns) const {
  const auto after = std::lower_bound(poses_.begin(), poses_.end(), time_ns,
                                      [](const TimedPose &pose, int64_t time) { return pose.time_ns < time; });
  const auto before = after == poses_.begin() ? poses_.end() : after - 1;
  const uint64_t to_before = before == poses_.end() ? UINT64_MAX : timeBetween(before->time_ns, time_ns);
  const uint64_t to_after = after == poses_.end() ? UINT64_MAX : timeBetween(time_ns, after->time_ns);
  if (to_after == 0) return after->pose;
  if (before != poses_.end() && after != poses_.end() && to_before + to_after <= static_cast<uint64_t>(gap_ns))
    return interpolate(before->pose, after->pose,
                       static_cast<double>(to_before) / static_cast<double>(to_before + to_after));
  if (std::min(to_before, to_after) > kSameTimeNs) return {};
  return (to_before < to_after ? before : after)->pose;
}

std::optional<uint64_t> PoseTrack::gapAt(int64_t time_ns) const {
  const auto after = std::upper_bound(poses_.begin(), poses_.end(), time_ns,
                                      [](int64_t time, const TimedPose &pose) { return time < pose.time_ns; });
  if (after == poses_.begin() || after == poses_.end()) return {};
  return timeBetween((after - 1)->time_ns, after->time_ns);
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
  host::normalizeQuaternion(pose.q_wxyz, 1.0);
  return pose;
}

bool isFinite(const sphc_rigid &pose) {
  const auto finite = [](double x) { return std::isfinite(x); };
  return std::all_of(pose.q_wxyz, pose.q_wxyz + 4, finite) && std::all_of(pose.t_m, pose.t_m + 3, finite);
}

sphc_rigid checkedPose(const sphc_rigid &pose) {
  sphc_rigid checked = pose;
  if (!isFinite(checked)) throw Failure(SPHC_E_ARGUMENT, "pose: not finite; leave out frames that have none");
  if (!host::normalizeQuaternion(checked.q_wxyz, 1e-3))
    throw Failure(SPHC_E_ARGUMENT, "pose: q_wxyz is not of unit length; divide by its length");
  return checked;
}

}  // namespace sphc::recording
