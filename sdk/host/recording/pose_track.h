// The recorded poses of the colour camera, looked up by time.
#pragma once

#include <spherecloud/spherecloud.h>

#include <cstdint>
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
  // Exact at a recorded time, else between neighbours at most `gap_ns` apart.
  bool at(int64_t time_ns, int64_t gap_ns, sphc_rigid &world_from_camera) const;
  const std::vector<TimedPose> &poses() const { return poses_; }

 private:
  std::vector<TimedPose> poses_;
};

// Rotation about the shorter arc at constant speed, translation on a line; `s` from 0 to 1.
sphc_rigid interpolate(const sphc_rigid &from, const sphc_rigid &to, double s);

bool isFinite(const sphc_rigid &pose);
// Makes the quaternion one of unit length; false if it was further from it than `tolerance`.
bool normalizeQuaternion(double q_wxyz[4], double tolerance);
// The pose with its quaternion of unit length; throws Failure (ARGUMENT) when it is not finite or far from one.
sphc_rigid checkedPose(const sphc_rigid &pose);
// False when `rows` (row-major 3 x 4 of a 4 x 4 matrix) is not finite or its left part no rotation.
bool rigidFromMatrix(const double rows[12], sphc_rigid &pose);

}  // namespace sphc::recording
