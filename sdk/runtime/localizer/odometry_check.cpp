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

void OdometryCheck::look(const Known &known, const Hypothesis &found) {
  if (contradictions_ > 0 && elapsedNs(contradicted_ns_, now_ns_) > Tracker::kForgetCarriedNs) {
    --contradictions_;
    contradicted_ns_ = now_ns_;
  }
  has_last_ = has_last_ && known.has_odometry;
  if (!known.has_odometry) return;
  const Odometry &odometry = known.odometry;
  turn_variance_ += odometry.rotation_sigma_rad * odometry.rotation_sigma_rad;
  shift_variance_ += odometry.translation_sigma_m * odometry.translation_sigma_m;
  if (!found.isLocalized()) return;
  const Matrix6 covariance = statedCovariance(found.estimate);
  const uint32_t number = unused();
  Look &now = looks_[number];
  now.map = found.map;
  now.time_ns = now_ns_;
  now.odometry_from_map = odometry.odometry_from_camera * found.estimate.camera_from_map;
  now.centre_in_map_m = found.estimate.camera_from_map.inverse().translation_m;
  now.centre_in_odometry_m = odometry.odometry_from_camera.translation_m;
  now.pose_turn = axisSigma(covariance, 0);
  now.pose_shift = axisSigma(covariance, 3);
  now.odometry_turn = turn_variance_;
  now.odometry_shift = shift_variance_;
  compare(number);
}

uint32_t OdometryCheck::unused() const {
  uint32_t number = 0;
  while (number == last_ || number == anchor_) ++number;
  return number;
}

// A jump between two frames that only one of them knows is a wrong pose, or odometry in another frame: one pose
// that is wrong makes two of them.
void OdometryCheck::compare(uint32_t number) {
  const Look &now = looks_[number];
  const bool follows = this->follows(now), is_apart = follows && contradict(looks_[last_], now);
  steps_apart_ = is_apart ? steps_apart_ + 1 : 0;
  const bool is_contradicted = is_apart ? steps_apart_ >= kStepsApart : follows && contradict(looks_[anchor_], now);
  if (is_contradicted) {
    contradictions_ = std::min(contradictions_ + 1, kContradictionsOfOdometry);
    contradicted_ns_ = now.time_ns;
  }
  const bool is_old = elapsedNs(looks_[anchor_].time_ns, now.time_ns) > Tracker::kForgetCarriedNs;
  if (!follows || is_apart || is_contradicted || is_old) anchor_ = number;
  last_ = number;
  has_last_ = true;
}

bool OdometryCheck::disagrees() const { return contradictions_ >= kContradictionsOfOdometry; }

bool OdometryCheck::follows(const Look &now) const {
  const Look &last = looks_[last_];
  return has_last_ && now.map == last.map && secondsOf(elapsedNs(last.time_ns, now.time_ns)) <= kSteadySeconds;
}

bool OdometryCheck::contradict(const Look &before, const Look &now) {
  const Rigid apart = now.odometry_from_map * before.odometry_from_map.inverse();
  const Vector3 by_poses_m = before.odometry_from_map * now.centre_in_map_m - before.centre_in_odometry_m;
  const Vector3 by_odometry_m = now.centre_in_odometry_m - before.centre_in_odometry_m;
  // An error of the direction that the way begins with grows with the way.
  const double direction_rad = hypotOf(before.pose_turn, sqrtOf(now.odometry_turn - before.odometry_turn)),
               ends_m = hypotOf(before.pose_shift, now.pose_shift),
               way_m = sqrtOf(now.odometry_shift - before.odometry_shift);
  const PoseBounds most = boundsOfNoJump(hypotOf(direction_rad, now.pose_turn),
                                         hypotOf(hypotOf(ends_m, way_m), direction_rad * by_odometry_m.norm()));
  return rotationAngle(apart.rotation) > most.most_turn_rad ||
         shiftApart(by_poses_m, by_odometry_m) > most.most_shift_m;
}

}  // namespace sphc
