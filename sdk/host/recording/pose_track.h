// The recorded poses of the colour camera, looked up by time.
#pragma once

#include <spherecloud/spherecloud.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace sphc::recording {

struct TimedPose {
  int64_t time_ns;
  sphc_rigid pose;
};

class PoseTrack {
 public:
  // Times must not decrease; of equal times the first counts.
  void add(int64_t time_ns, const sphc_rigid &world_from_camera);
  // Exact at a recorded time, else between neighbours at most `gap_ns` apart, else of a time at most 1 us away.
  std::optional<sphc_rigid> at(int64_t time_ns, int64_t gap_ns) const;
  // How far apart the neighbours of a time are; none before the first and after the last.
  std::optional<uint64_t> gapAt(int64_t time_ns) const;
  const std::vector<TimedPose> &poses() const { return poses_; }

 private:
  std::vector<TimedPose> poses_;
};

// Rotation about the shorter arc at constant speed, translation on a line; `s` from 0 to 1.
sphc_rigid interpolate(const sphc_rigid &from, const sphc_rigid &to, double s);

bool isFinite(const sphc_rigid &pose);
// The pose with its quaternion of unit length; throws Failure (ARGUMENT) when it is not finite or far from one.
sphc_rigid checkedPose(const sphc_rigid &pose);

}  // namespace sphc::recording
