#include "runtime/localizer/motion.h"

#include <algorithm>
#include <cstring>

#include "runtime/base/clock.h"
#include "runtime/localizer/tracker.h"
#include "runtime/localizer/tuning.h"
#include "runtime/stages/pose/confidence.h"

namespace sphc {
namespace {

using namespace tuning;

double square(double value) { return value * value; }

// 1 sigma an axis of what a head may do in the time, and in its rate.  A rate is that of the middle of its step.
struct Unknown {
  double way, rate;
};

Unknown unknownOf(double ahead_s, double step_s, double most_rate, double acceleration) {
  if (!(step_s > 0)) return {most_rate * absOf(ahead_s), most_rate};
  return {0.5 * acceleration * absOf(ahead_s * (ahead_s + step_s)), acceleration * absOf(ahead_s + 0.5 * step_s)};
}

// What errors of turn and shift have in common so many steps after a pose (before it: fewer than 0), over what they
// have there.  Before it they are mixed with those of the pose before, turn and shift by other shares.
double commonOf(double steps, const Step &step) {
  const double turn = steps * step.turn_gain, shift = steps * step.shift_gain;
  return std::max(0.0, (1 + turn) * (1 + shift) + turn * shift);
}

// Of a pose and a step by poses, so many steps before the pose.
Matrix6 covarianceBefore(double steps, const Matrix6 &of_pose, const Step &step) {
  const double of_step = steps * (steps + 2 * step.share_in_pose);
  // Where the errors of two poses mean out, they do so by as much along every axis: else no covariance is left.
  const double least = 2 * std::min(step.turn_gain, step.shift_gain);
  Matrix6 covariance = of_pose + of_step * (of_step < 0 ? Matrix6(least * of_pose) : step.covariance);
  const double common = 1 + of_step * (of_step < 0 ? least : 2 * sqrtOf(step.turn_gain * step.shift_gain));
  const double kept = std::min(1.0, commonOf(steps, step) / common);
  covariance.topRightCorner<3, 3>() *= kept;
  covariance.bottomLeftCorner<3, 3>() *= kept;
  return covariance;
}

}  // namespace

Matrix6 diagonalOf(double rotation_sigma_rad, double translation_sigma_m) {
  Vector6 sigmas;
  sigmas << Vector3::Constant(rotation_sigma_rad), Vector3::Constant(translation_sigma_m);
  return sigmas.cwiseAbs2().asDiagonal();
}

Matrix6 carried(const Matrix6 &covariance, const Rigid &now_from_before) {
  Matrix6 adjoint = Matrix6::Zero();
  adjoint.topLeftCorner<3, 3>() = adjoint.bottomRightCorner<3, 3>() = now_from_before.rotation;
  adjoint.bottomLeftCorner<3, 3>() = crossMatrix(now_from_before.translation_m) * now_from_before.rotation;
  const Matrix6 moved = adjoint * covariance * adjoint.transpose();
  return 0.5 * (moved + moved.transpose());
}

void Rate::add(const Vector3 &of_step, double variance_of_step, double variance_outdated) {
  variance += variance_outdated;
  gain = variance / (variance + variance_of_step);
  a_second += gain * (of_step - a_second);
  variance = gain * variance_of_step;
}

void Trail::add(int64_t time_ns, const Rigid &camera_from_map, const Matrix6 &covariance) {
  newest_ = (newest_ + 1) % kCapacity;
  Place &place = places_[newest_];
  place.time_ns = time_ns;
  std::memcpy(place.rotation, camera_from_map.rotation.data(), sizeof place.rotation);
  std::memcpy(place.translation_m, camera_from_map.translation_m.data(), sizeof place.translation_m);
  std::memcpy(place.covariance, covariance.data(), sizeof place.covariance);
}

Matrix6 Trail::covariance() const { return Matrix6(ago(0).covariance); }

Step Trail::step(uint32_t steps) const {
  if (steps == 0) return {};
  Rate turn = {Vector3::Zero(), kTurnRate * kTurnRate, 0}, shift = {Vector3::Zero(), kSpeed * kSpeed, 0};
  double dt = 0;
  for (uint32_t i = std::min(steps, kCapacity - 1); i-- > 0;) {
    const Place &from = ago(i + 1), &to = ago(i);
    dt = secondsOf(elapsedNs(from.time_ns, to.time_ns));
    const Rigid before = {Matrix3(from.rotation), Vector3(from.translation_m)},
                now = {Matrix3(to.rotation), Vector3(to.translation_m)};
    const Vector3 turn_in_map_rad =
        now.rotation.transpose() * vectorFromRotation(before.rotation * now.rotation.transpose());
    const Vector3 way_in_map_m = now.inverse().translation_m - before.inverse().translation_m;
    const Matrix6 of_from(from.covariance), of_to(to.covariance);
    const auto varianceOf = [&](int first) {  // of the difference of two poses
      return square(axisSigma(of_from, first) / dt) + square(axisSigma(of_to, first) / dt);
    };
    turn.add(turn_in_map_rad / dt, varianceOf(0), square(kTurnAcceleration * dt));
    shift.add(way_in_map_m / dt, varianceOf(3), square(kAcceleration * dt));
  }
  Vector6 shares;
  shares << Vector3::Constant(sqrtOf(2 * turn.gain)), Vector3::Constant(sqrtOf(2 * shift.gain));
  return {dt,  dt * turn.a_second, dt * shift.a_second, shares.asDiagonal() * covariance() * shares.asDiagonal(),
          0.5, turn.gain,          shift.gain};
}

bool moveTo(int64_t time_ns, const Motion &motion, MovedPose *moved) {
  const bool before = time_ns < motion.time_ns;
  const uint64_t apart_ns = apartNs(time_ns, motion.time_ns);
  if (before && apart_ns > kNearNs) return false;
  if (elapsedNs(motion.pose_time_ns, time_ns) > Tracker::kForgetNs) return false;
  const double ahead_s = before ? -secondsOf(apart_ns) : secondsOf(apart_ns);
  const Step &step = motion.step;
  const double steps_per_s = step.seconds > 0 ? 1 / step.seconds : 0, steps = ahead_s * steps_per_s;

  // The camera turns at its rate, and its centre goes in a straight line.
  const Matrix3 turned = rotationFromVector(-steps * (motion.camera_from_map.rotation * step.turn_in_map_rad));
  const Matrix3 rotation = turned * motion.camera_from_map.rotation;
  const Vector3 centre_m = motion.camera_from_map.inverse().translation_m + steps * step.way_in_map_m;
  moved->map = motion.map;
  moved->pose_time_ns = motion.pose_time_ns;
  moved->camera_from_map = {rotation, -(rotation * centre_m)};
  moved->velocity_in_map_m_s = steps_per_s * step.way_in_map_m;
  moved->angular_velocity_in_map_rad_s = steps_per_s * step.turn_in_map_rad;

  const Unknown turn = unknownOf(ahead_s, step.seconds, kTurnRate, kTurnAcceleration),
                shift = unknownOf(ahead_s, step.seconds, kSpeed, kAcceleration);
  const bool is_between = before && step.turn_gain > 0;
  const Matrix6 covariance =
      is_between ? covarianceBefore(steps, motion.covariance, step)
                 : Matrix6(motion.covariance + steps * (steps + 2 * step.share_in_pose) * step.covariance);
  moved->covariance = carried(covariance, {turned, Vector3::Zero()}) + diagonalOf(turn.way, shift.way);
  moved->angular_velocity_sigma_rad_s = hypotOf(turn.rate, steps_per_s * axisSigma(step.covariance, 0));
  moved->velocity_sigma_m_s = hypotOf(shift.rate, steps_per_s * axisSigma(step.covariance, 3));
  return true;
}

}  // namespace sphc
