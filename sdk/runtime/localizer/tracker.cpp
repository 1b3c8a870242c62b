#include "runtime/localizer/tracker.h"

#include <algorithm>

#include "runtime/base/clock.h"
#include "runtime/localizer/judgement.h"
#include "runtime/localizer/tuning.h"
#include "runtime/stages/pose/confidence.h"

namespace sphc {
namespace {

using namespace tuning;

constexpr double kTwoPoses = 2.236;  // of 2 a - b, where a and b have standard deviation 1

double seconds(uint64_t ns) { return 1e-9 * static_cast<double>(ns); }

double sigmaAnAxis(const Estimate &estimate, int first) {
  return doubtOf(estimate.inliers) * sqrtOf(estimate.covariance.block<3, 3>(first, first).trace() / 3);
}

Jump offBetween(const Rigid &found, const Rigid &expected) {
  const Vector3 shift_m = found.inverse().translation_m - expected.inverse().translation_m;
  return {0, shift_m.norm(), rotationAngle(found.rotation * expected.rotation.transpose())};
}

}  // namespace

void Tracker::advance(int64_t time_ns, const Odometry *odometry) {
  const bool follows = begun_ && time_ns > time_ns_ && elapsedNs(time_ns_, time_ns) <= kForgetNs;
  if (!follows) reset();
  step_ns_ = follows ? elapsedNs(time_ns_, time_ns) : 0;
  has_step_ = follows && has_odometry_ && odometry;
  if (has_step_) {
    step_ = odometry->odometry_from_camera.inverse() * odometry_.odometry_from_camera;
    moved_ = step_ * moved_;
    moved_rotation2_ += odometry->rotation_sigma_rad * odometry->rotation_sigma_rad;
    moved_translation2_ += odometry->translation_sigma_m * odometry->translation_sigma_m;
  }
  moved_known_ = moved_known_ && has_step_;
  has_odometry_ = odometry != nullptr;
  if (odometry) odometry_ = *odometry;
  time_ns_ = time_ns;
  begun_ = true;
  if (elapsedNs(pose_time_ns_, time_ns) > kForgetNs) has_pose_ = has_velocity_ = false;
  if (elapsedNs(trusted_time_ns_, time_ns) > kForgetNs) state_ = TrackingState::kRelocalizing;
}

bool Tracker::step(Rigid *now_from_before, double *rotation_sigma_rad, double *translation_sigma_m) const {
  *now_from_before = step_;
  *rotation_sigma_rad = odometry_.rotation_sigma_rad;
  *translation_sigma_m = odometry_.translation_sigma_m;
  return has_step_;
}

// Turns and moves at the rate of the last step; the camera's centre in a straight line.
bool Tracker::motionSince(int64_t then_ns, Rigid *now_from_then) const {
  const bool before = then_ns <= time_ns_;
  const uint64_t apart_ns = before ? elapsedNs(then_ns, time_ns_) : elapsedNs(time_ns_, then_ns);
  if (!has_step_ || seconds(step_ns_) > kSteadySeconds || apart_ns > kNearNs) return false;
  const double share = seconds(apart_ns) / seconds(step_ns_), then = before ? 1 - share : 1 + share;
  const Matrix3 turned = rotationFromVector(then * vectorFromRotation(step_.rotation));
  const Vector3 center = then * step_.inverse().translation_m;  // in the camera's frame at the frame before
  *now_from_then = step_ * Rigid{turned, -(turned * center)}.inverse();
  return true;
}

bool Tracker::predict(Prediction *prediction) const {
  if (!has_pose_) return false;
  prediction->map = map_;
  double turn = 0, shift = 0, poses = 1;  // standard deviations; those of poses count so many times
  Rigid moved;
  if (moved_known_) {
    moved = moved_;
    turn = sqrtOf(moved_rotation2_);
    shift = sqrtOf(moved_translation2_);
  } else {
    const double dt = seconds(elapsedNs(pose_time_ns_, time_ns_));
    if (has_velocity_) moved = {rotationFromVector(dt * turn_rad_s_), dt * velocity_m_s_};
    if (has_velocity_) poses = kTwoPoses;
    turn = has_velocity_ ? 0.5 * kTurnAcceleration * dt * dt : kTurnRate * dt;
    shift = has_velocity_ ? 0.5 * kAcceleration * dt * dt : kSpeed * dt;
  }
  prediction->camera_from_map = moved * camera_from_map_;
  prediction->rotation_sigma_rad = hypotOf(turn, poses * rotation_sigma_rad_);
  prediction->translation_sigma_m = hypotOf(shift, poses * translation_sigma_m_);
  return true;
}

Jump Tracker::jumpTo(uint32_t map, const Rigid &camera_from_map) const {
  Prediction expected;
  if (!predict(&expected)) return {kRelocalized, 0, 0};
  if (expected.map != map) return {kMapChanged, 0, 0};
  Jump jump = offBetween(camera_from_map, expected.camera_from_map);
  const bool agrees = jump.turn_rad < kGateSigmas * expected.rotation_sigma_rad &&
                      jump.shift_m < kGateSigmas * expected.translation_sigma_m;
  jump.events = agrees ? Events{0} : kJumped;
  return jump;
}

Jump Tracker::accept(uint32_t map, const Estimate &estimate) {
  const Jump jump = jumpTo(map, estimate.camera_from_map);
  if (!jump.events)
    state_ = TrackingState::kTracking;
  else if (state_ == TrackingState::kTracking)
    state_ = TrackingState::kLost;
  velocity_ns_ = elapsedNs(pose_time_ns_, time_ns_);
  const double dt = seconds(velocity_ns_);
  has_velocity_ = state_ == TrackingState::kTracking && dt <= kSteadySeconds;
  if (has_velocity_) {
    const Rigid moved = estimate.camera_from_map * camera_from_map_.inverse();
    turn_rad_s_ = vectorFromRotation(moved.rotation) / dt;
    velocity_m_s_ = moved.translation_m / dt;
  } else {
    turn_rate_ = {Vector3::Zero(), kTurnRate * kTurnRate, 0};
    shift_rate_ = {Vector3::Zero(), kSpeed * kSpeed, 0};
  }
  if (state_ == TrackingState::kTracking) trusted_time_ns_ = time_ns_;
  has_pose_ = moved_known_ = true;
  map_ = map;
  pose_time_ns_ = time_ns_;
  camera_from_map_ = estimate.camera_from_map;
  covariance_ = statedCovariance(estimate);
  if (has_velocity_) smoothRates(dt);
  rotation_sigma_rad_ = hypotOf(sigmaAnAxis(estimate, 0), kLeastTurnSigma);
  translation_sigma_m_ = hypotOf(sigmaAnAxis(estimate, 3), kLeastShiftSigma);
  inliers_ = estimate.inliers;
  moved_ = {};
  moved_rotation2_ = moved_translation2_ = 0;
  return jump;
}

bool Tracker::vetoes(uint32_t map, const Estimate &estimate) const {
  Prediction expected;
  const bool is_known = state_ != TrackingState::kRelocalizing && moved_known_ && predict(&expected);
  if (!is_known || expected.map != map || estimate.inliers >= inliers_) return false;
  const Jump jump = offBetween(estimate.camera_from_map, expected.camera_from_map);
  const auto jumps = [](double off, double expected_sigma, double own_sigma, double most) {
    return off > std::max(most, kGateSigmas * hypotOf(expected_sigma, own_sigma));
  };
  return jumps(jump.turn_rad, expected.rotation_sigma_rad, sigmaAnAxis(estimate, 0), kNoJump.most_turn_rad) ||
         jumps(jump.shift_m, expected.translation_sigma_m, sigmaAnAxis(estimate, 3), kNoJump.most_shift_m);
}

// Once the new pose is the last one.
void Tracker::smoothRates(double dt) {
  const Matrix3 map_from_camera = camera_from_map_.rotation.transpose();
  const double turn_2 = 2 / 3.0 * covariance_.topLeftCorner<3, 3>().trace() / (dt * dt),
               shift_2 = 2 / 3.0 * covariance_.bottomRightCorner<3, 3>().trace() / (dt * dt);
  turn_rate_.add(-(map_from_camera * turn_rad_s_), turn_2, kTurnAcceleration * kTurnAcceleration * dt * dt);
  shift_rate_.add(-(map_from_camera * velocity_m_s_), shift_2, kAcceleration * kAcceleration * dt * dt);
}

void Tracker::miss() {
  if (state_ == TrackingState::kTracking) state_ = TrackingState::kLost;
}

bool Tracker::motion(Motion *motion) const {
  if (!has_pose_) return false;
  *motion = {map_, pose_time_ns_, pose_time_ns_, camera_from_map_, covariance_, lastStep()};
  if (!moved_known_ || time_ns_ == pose_time_ns_) return true;
  motion->time_ns = time_ns_;
  motion->camera_from_map = moved_ * camera_from_map_;
  motion->covariance =
      carried(covariance_, moved_) + diagonalOf(sqrtOf(moved_rotation2_), sqrtOf(moved_translation2_));
  return true;
}

// To the pose of motion().
Step Tracker::lastStep() const {
  const bool is_found = time_ns_ == pose_time_ns_;
  if (moved_known_ && has_step_ && seconds(step_ns_) <= kSteadySeconds) {
    const Matrix3 map_from_camera = (moved_ * camera_from_map_).rotation.transpose();
    return {seconds(step_ns_), -(map_from_camera * vectorFromRotation(step_.rotation)),
            -(map_from_camera * step_.translation_m),
            diagonalOf(odometry_.rotation_sigma_rad, odometry_.translation_sigma_m), is_found ? 0.0 : 1.0};
  }
  if (!has_velocity_ || (moved_known_ && !is_found)) return {};
  // Of the last two poses, which are equally good, as much as counts in the rates.
  Vector6 shares;
  shares << Vector3::Constant(sqrtOf(2 * turn_rate_.gain)), Vector3::Constant(sqrtOf(2 * shift_rate_.gain));
  const double dt = seconds(velocity_ns_);
  return {dt, dt * turn_rate_.a_second, dt * shift_rate_.a_second,
          shares.asDiagonal() * covariance_ * shares.asDiagonal(), 0.5};
}

}  // namespace sphc
