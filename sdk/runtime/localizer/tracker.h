// The tracking states, and where the camera should be next: from the caller's odometry, or else at constant
// velocity.
//
//   RELOCALIZING  no pose is trusted
//   TRACKING      the last pose is: it agrees with the one before, and so on back to a sure one
//   LOST          it was, until the last frame brought none or another
//
//   from           a frame brings                            to
//   RELOCALIZING   a pose that agrees with the one before,
//                  where one of those that agree is sure     TRACKING
//                  another pose, or none                     RELOCALIZING
//   TRACKING       a pose where it was expected              TRACKING
//                  another pose, or none                     LOST
//   LOST           such a pose, expected nearly enough to
//                  tell, or a sure one                       TRACKING
//                  nothing trusted for kForgetNs            RELOCALIZING
//                  (what odometry carries is expected for longer: kForgetCarriedNs)
//   any            a time that does not grow, or a gap of    RELOCALIZING
//                  more than kForgetNs
#pragma once
#include "runtime/localizer/carried_pose.h"
#include "runtime/localizer/frame.h"
#include "runtime/localizer/map_set.h"
#include "runtime/localizer/motion.h"
#include "runtime/localizer/recent_steps.h"
#include "runtime/localizer/result.h"
#include "runtime/localizer/tuning.h"

namespace sphc {

// Where the camera should be; 1 sigma an axis, the translation's of the camera's centre.
struct Prediction {
  uint32_t map = 0;
  Rigid camera_from_map;
  double rotation_sigma_rad = 0, translation_sigma_m = 0;
};

// What a pose that is no jump differs by at most from where the camera is expected; 1 sigma an axis.
tuning::PoseBounds boundsOfNoJump(double rotation_sigma_rad, double translation_sigma_m,
                                  const tuning::PoseBounds &least = tuning::kNoJump);

// How a point that stands still moves in the camera's own frame: by turn x point + shift, a second; 1 sigma an
// axis. The default is a head of whose motion nothing is known.
struct CameraRate {
  Vector3 turn_rad_s = Vector3::Zero(), shift_m_s = Vector3::Zero();
  double turn_sigma_rad_s = tuning::kTurnRate, shift_sigma_m_s = tuning::kSpeed;
};
// A measured rate together with what is known of all heads: a vague one is less than was measured.
CameraRate ofAHead(const CameraRate &measured);

// The same camera in another map; false where it is in that map already, or where it is not known how the two lie.
bool carriedOver(const Prediction &expected, uint32_t map, const MapSet &maps, Prediction *there);

class Tracker {
 public:
  // So long a pose says something of where the camera is: by itself, and carried by odometry.
  static constexpr uint64_t kForgetNs = 1000000000, kForgetCarriedNs = 10000000000;

  // Before each frame is processed.  `odometry` may be null.
  void advance(int64_t time_ns, const Odometry *odometry);
  // After advance: false where nothing can be said.
  bool predict(Prediction *prediction) const;
  // Before accept: what is known of the camera, in the map that it is found in.
  void goOver(uint32_t map, const MapSet &maps);
  // After it: what it brought, and how far that is from what was expected.  `confidence` says how sure the pose is;
  // `is_doubted`: by a fault, so that it is not to be trusted as a track is; `between_m` what is not known of the
  // camera's way between the images of the frame, and while rows were exposed, 1 sigma an axis, which the
  // covariance has too.
  Jump accept(uint32_t map, const Estimate &estimate, double confidence, bool is_doubted = false,
              double between_m = 0);
  void miss();
  // Before accept: is this a jump that odometry contradicts, or that no head can make, and that much more would
  // have to speak for than for the track?
  bool vetoes(uint32_t map, const Estimate &estimate) const;

  TrackingState state() const { return state_; }
  // Does what is expected go on from a pose that was sure, and tell where the camera is?
  bool isSure() const;
  // How far the camera went between frames?
  bool knowsShifts() const { return has_odometry_ && odometry_.scale_sigma == 0; }
  // Motion of the camera since the frame before, by odometry; false where it is not known.
  bool step(Rigid *now_from_before, double *rotation_sigma_rad, double *translation_sigma_m) const;
  // How the camera moved since another time near this frame's, by the odometry of the steps before (RecentSteps);
  // false where that says nothing.
  bool waySince(int64_t then_ns, Way *way) const;
  // At this frame, by odometry; false where that says nothing.
  bool rate(CameraRate *rate) const;
  // After the frame: how the camera moves, for times of the caller's; false where no pose is known.  The trail has
  // every pose that was accepted.
  bool motion(const Trail &trail, Motion *motion) const;
  void reset();
  // The map in this slot is gone.
  void forget(uint32_t map) {
    if (has_pose_ && map == last_.map) reset();
    if (map == best_.map) best_.inliers = 0;
  }

 private:
  // A rate of the camera's step between two poses, in its own frame.
  struct StepRate {
    Vector3 a_second = Vector3::Zero();
    double before = 0, now = 0;  // of the two poses, 1 sigma an axis
  };
  // What is known of the camera after `dt`: by the rate of the last step, or where that says less, by how fast
  // heads are.
  struct Ahead {
    bool is_steady;
    double sigma;  // an axis
  };
  Ahead ahead(double dt, double pose_sigma, const StepRate &rate, double most_rate, double acceleration) const;
  Jump jumpTo(uint32_t map, const Rigid &found, Prediction *expected) const;
  bool jumpsFrom(const CarriedPose &pose, uint32_t map, const Rigid &found) const;
  double support() const;

  TrackingState state_ = TrackingState::kRelocalizing;
  int64_t time_ns_ = 0;
  bool begun_ = false;

  bool has_odometry_ = false, has_step_ = false;
  Odometry odometry_;
  Rigid step_;  // camera now from camera at the frame before
  uint64_t step_ns_ = 0;
  RecentSteps steps_;  // it and those before, while each follows the other

  bool has_pose_ = false;
  CarriedPose last_;  // that was found
  double rotation_sigma_rad_ = 0, translation_sigma_m_ = 0;
  CarriedPose best_;      // the one of this track that most speaks for; none where it has no inliers
  bool is_sure_ = false;  // it, or one before it that it goes on from
  int64_t trusted_time_ns_ = 0;

  bool has_velocity_ = false;
  StepRate turn_, shift_;   // rad, m
  double velocity_s_ = 0;   // how long that step took
  bool went_over_ = false;  // to another map, since the last pose
  uint32_t steady_ = 0;     // steps between poses since the last jump or pause
};

}  // namespace sphc
