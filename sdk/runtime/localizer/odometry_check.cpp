#include "runtime/localizer/odometry_check.h"

#include <algorithm>

#include "runtime/base/clock.h"
#include "runtime/localizer/judgement.h"
#include "runtime/localizer/tuning.h"
#include "runtime/stages/pose/confidence.h"

namespace sphc {

using namespace tuning;

namespace {

// What is left of a shift by poses after that of odometry, where depth may have a scale.
double shiftApart(const Vector3 &by_poses, const Vector3 &by_odometry) {
  const double scale = by_odometry.dot(by_poses) / std::max(by_odometry.squaredNorm(), 1e-12);
  return (by_poses - std::min(std::max(scale, 1 / kMostScaleOfDepth), kMostScaleOfDepth) * by_odometry).norm();
}

}  // namespace

void OdometryCheck::look(int64_t time_ns, const Known &known, const Hypothesis &found) {
  if (time_ns <= now_ns_) reset();
  now_ns_ = time_ns;
  if (contradictions_ > 0 && elapsedNs(contradicted_ns_, time_ns) > Tracker::kForgetCarriedNs) {
    --contradictions_;
    contradicted_ns_ = time_ns;
  }
  has_last_ = has_last_ && known.has_odometry;
  if (!known.has_odometry) return;
  const Odometry &odometry = known.odometry;
  turn_variance_ += odometry.rotation_sigma_rad * odometry.rotation_sigma_rad;
  shift_variance_ += odometry.translation_sigma_m * odometry.translation_sigma_m;
  if (!found.isLocalized()) return;
  const Matrix6 covariance = statedCovariance(found.estimate);
  compare({found.map, time_ns, found.estimate.camera_from_map, odometry.odometry_from_camera,
           covariance.topLeftCorner<3, 3>().trace() / 3, covariance.bottomRightCorner<3, 3>().trace() / 3,
           turn_variance_, shift_variance_});
}

// A jump between two frames that only one of them knows is a wrong pose, or odometry in another frame: one pose
// that is wrong makes two of them.
void OdometryCheck::compare(const Look &now) {
  const bool follows = this->follows(now), is_apart = follows && contradict(last_, now);
  steps_apart_ = is_apart ? steps_apart_ + 1 : 0;
  const bool is_contradicted = is_apart ? steps_apart_ >= kStepsApart : follows && contradict(anchor_, now);
  if (is_contradicted) {
    contradictions_ = std::min(contradictions_ + 1, kContradictionsOfOdometry);
    contradicted_ns_ = now.time_ns;
  }
  const bool is_old = elapsedNs(anchor_.time_ns, now.time_ns) > Tracker::kForgetCarriedNs;
  if (!follows || is_apart || is_contradicted || is_old) anchor_ = now;
  last_ = now;
  has_last_ = true;
}

bool OdometryCheck::disagrees() const { return contradictions_ >= kContradictionsOfOdometry; }

bool OdometryCheck::follows(const Look &now) const {
  return has_last_ && now.map == last_.map && secondsOf(elapsedNs(last_.time_ns, now.time_ns)) <= kSteadySeconds;
}

bool OdometryCheck::contradict(const Look &before, const Look &now) {
  const Rigid by_poses = before.camera_from_map * now.camera_from_map.inverse();
  const Rigid by_odometry = before.odometry_from_camera.inverse() * now.odometry_from_camera;
  const PoseBounds most =
      boundsOfNoJump(sqrtOf(before.pose_turn + now.pose_turn + now.odometry_turn - before.odometry_turn),
                     sqrtOf(before.pose_shift + now.pose_shift + now.odometry_shift - before.odometry_shift));
  return rotationAngle(by_poses.rotation * by_odometry.rotation.transpose()) > most.most_turn_rad ||
         shiftApart(by_poses.translation_m, by_odometry.translation_m) > most.most_shift_m;
}

}  // namespace sphc
