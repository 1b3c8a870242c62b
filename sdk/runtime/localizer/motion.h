// How the camera moves, by the last frames, and where that takes it at a time of its own: ahead at the rate of the
// last step.  The error grows by what is unknown of that rate, and by how heads accelerate.
#pragma once
#include "runtime/types/estimate.h"

namespace sphc {

// A rate along three axes, from steps between poses: each step counts as much as its error allows against what was
// known before, which heads outdate by accelerating (a Kalman filter).
struct Rate {
  Vector3 a_second = Vector3::Zero();
  double variance = 0;  // an axis
  double gain = 0;      // of the last step

  void add(const Vector3 &of_step, double variance_of_step, double variance_outdated);
};

// How the camera came from where it was before, or would have by its rates.
struct Step {
  double seconds = 0;  // 0: not known
  Vector3 turn_in_map_rad = Vector3::Zero(), way_in_map_m = Vector3::Zero();
  Matrix6 covariance = Matrix6::Zero();  // as that of a result
  // Covariance of the errors of this step and of the pose it led to, over that of this step.
  double share_in_pose = 0;
  // Of steps between poses: by how much the last pose counts in the rates, so that twice as much of its covariance
  // is in that of this step.
  double turn_gain = 0, shift_gain = 0;
};

// The last poses, of one map or several, as they were found.
class Trail {
 public:
  static constexpr uint32_t kCapacity = 6;
  void add(int64_t time_ns, const Rigid &camera_from_map, const Matrix6 &covariance);
  // Of the last one, as that of a result.
  Matrix6 covariance() const;
  // By the last poses and the steps between them, at most so many.
  Step step(uint32_t steps) const;

 private:
  struct Place {  // copied as bytes: little code
    int64_t time_ns;
    double rotation[9], translation_m[3], covariance[36];  // camera_from_map
  };
  const Place &ago(uint32_t poses) const { return places_[(newest_ + kCapacity - poses) % kCapacity]; }

  Place places_[kCapacity];
  uint32_t newest_ = 0;
};

struct Motion {
  uint32_t map = 0;          // its slot
  int64_t pose_time_ns = 0;  // of the last frame that had a pose
  // The pose then, or where odometry has taken it since.
  int64_t time_ns = 0;
  Rigid camera_from_map;
  Matrix6 covariance = Matrix6::Zero();  // as that of a result
  Step step;                             // to there, by odometry or between two poses
};

struct MovedPose {
  uint32_t map = 0;          // its slot
  int64_t pose_time_ns = 0;  // of the last frame that had a pose
  Rigid camera_from_map;
  Matrix6 covariance = Matrix6::Zero();  // as that of a result
  Vector3 velocity_in_map_m_s = Vector3::Zero(), angular_velocity_in_map_rad_s = Vector3::Zero();
  double velocity_sigma_m_s = 0, angular_velocity_sigma_rad_s = 0;  // 1 sigma an axis
};

// Of errors that are the same along every axis.
Matrix6 diagonalOf(double rotation_sigma_rad, double translation_sigma_m);
// The covariance of a pose once the camera has moved on.
Matrix6 carried(const Matrix6 &covariance, const Rigid &now_from_before);

// Where the camera is then.  False where motion says nothing: more than Tracker::kForgetNs after the pose, or well
// before the motion's time.
bool moveTo(int64_t time_ns, const Motion &motion, MovedPose *moved);

}  // namespace sphc
