#include "runtime/localizer/tracker.h"

#include <algorithm>

#include "runtime/base/clock.h"
#include "runtime/localizer/judgement.h"
#include "runtime/localizer/tuning.h"

namespace sphc {
namespace {

using namespace tuning;

constexpr double kTwoPoses = 2.236;  // of 2 a - b, where a and b have standard deviation 1

double sigmaAnAxis(const Estimate &estimate, int first) {
  return doubtOf(estimate.inliers) * sqrtOf(estimate.covariance.block<3, 3>(first, first).trace() / 3);
}

}  // namespace

bool carriedOver(const Prediction &expected, uint32_t map, const MapSet &maps, Prediction *there) {
  if (map == expected.map) return false;
  const Placement placement = maps.placementIn(expected.map, map);
  if (!placement.is_known) return false;
  const Rigid camera_from_map = expected.camera_from_map * placement.common_from_map;
  const double turned_m = placement.rotation_sigma_rad * camera_from_map.translation_m.norm();
  *there = {map, camera_from_map, hypotOf(expected.rotation_sigma_rad, placement.rotation_sigma_rad),
            hypotOf(expected.translation_sigma_m, hypotOf(placement.translation_sigma_m, turned_m))};
  return true;
}

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
  if (!has_step_ || secondsOf(step_ns_) > kSteadySeconds || apart_ns > kNearNs) return false;
  const double share = secondsOf(apart_ns) / secondsOf(step_ns_), then = before ? 1 - share : 1 + share;
  const Matrix3 turned = rotationFromVector(then * vectorFromRotation(step_.rotation));
  const Vector3 center = then * step_.inverse().translation_m;  // in the camera's frame at the frame before
  *now_from_then = step_ * Rigid{turned, -(turned * center)}.inverse();
  return true;
}

CameraRate Tracker::rate() const {
  constexpr uint64_t kApartNs = 5000000;
  CameraRate rate;
  Rigid now_from_then;
  const auto then_ns = static_cast<int64_t>(static_cast<uint64_t>(time_ns_) - kApartNs);  // times may be any
  if (!motionSince(then_ns, &now_from_then)) return rate;
  rate.turn_rad_s = vectorFromRotation(now_from_then.rotation) / secondsOf(kApartNs);
  rate.shift_m_s = now_from_then.translation_m / secondsOf(kApartNs);
  return rate;
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
    const double dt = secondsOf(elapsedNs(pose_time_ns_, time_ns_));
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

Jump Tracker::jumpTo(uint32_t map, const Rigid &found, Prediction *expected) const {
  if (!predict(expected)) return {kRelocalized, 0, 0};
  if (expected->map != map) return {kMapChanged, 0, 0};
  const Vector3 shift_m = found.inverse().translation_m - expected->camera_from_map.inverse().translation_m;
  Jump jump = {0, shift_m.norm(), rotationAngle(found.rotation * expected->camera_from_map.rotation.transpose())};
  const bool agrees = jump.turn_rad < kGateSigmas * expected->rotation_sigma_rad &&
                      jump.shift_m < kGateSigmas * expected->translation_sigma_m;
  jump.events = agrees ? Events{0} : kJumped;
  return jump;
}

void Tracker::goOver(uint32_t map, const MapSet &maps) {
  Prediction there;
  if (!has_pose_ ||
      !carriedOver({map_, camera_from_map_, rotation_sigma_rad_, translation_sigma_m_}, map, maps, &there))
    return;
  map_ = there.map;
  camera_from_map_ = there.camera_from_map;
  rotation_sigma_rad_ = there.rotation_sigma_rad;
  translation_sigma_m_ = there.translation_sigma_m;
  went_over_ = true;
}

Jump Tracker::accept(uint32_t map, const Estimate &estimate) {
  Prediction expected;
  Jump jump = jumpTo(map, estimate.camera_from_map, &expected);
  if (!jump.events)
    state_ = TrackingState::kTracking;
  else if (state_ == TrackingState::kTracking)
    state_ = TrackingState::kLost;
  const double dt = secondsOf(elapsedNs(pose_time_ns_, time_ns_));
  // Across maps the error of their transforms is no velocity: the one from before holds.
  const bool is_measured = !went_over_;
  has_velocity_ = state_ == TrackingState::kTracking && dt <= kSteadySeconds && (is_measured || has_velocity_);
  if (has_velocity_ && is_measured) {
    const Rigid moved = estimate.camera_from_map * camera_from_map_.inverse();
    turn_rad_s_ = vectorFromRotation(moved.rotation) / dt;
    velocity_m_s_ = moved.translation_m / dt;
  }
  steady_ = has_velocity_ && is_measured ? steady_ + 1 : 0;
  if (state_ == TrackingState::kTracking) trusted_time_ns_ = time_ns_;
  has_pose_ = moved_known_ = true;
  map_ = map;
  pose_time_ns_ = time_ns_;
  camera_from_map_ = estimate.camera_from_map;
  rotation_sigma_rad_ = hypotOf(sigmaAnAxis(estimate, 0), kLeastTurnSigma);
  translation_sigma_m_ = hypotOf(sigmaAnAxis(estimate, 3), kLeastShiftSigma);
  inliers_ = estimate.inliers;
  moved_ = {};
  moved_rotation2_ = moved_translation2_ = 0;
  if (went_over_) jump.events |= kMapChanged;
  went_over_ = false;
  return jump;
}

bool Tracker::vetoes(uint32_t map, const Estimate &estimate) const {
  if (state_ == TrackingState::kRelocalizing || !moved_known_ || estimate.inliers >= inliers_) return false;
  Prediction expected;
  const Jump jump = jumpTo(map, estimate.camera_from_map, &expected);
  if (jump.events != kJumped) return false;
  const auto jumps = [](double off, double expected_sigma, double own_sigma, double most) {
    return off > std::max(most, kGateSigmas * hypotOf(expected_sigma, own_sigma));
  };
  return jumps(jump.turn_rad, expected.rotation_sigma_rad, sigmaAnAxis(estimate, 0), kNoJump.most_turn_rad) ||
         jumps(jump.shift_m, expected.translation_sigma_m, sigmaAnAxis(estimate, 3), kNoJump.most_shift_m);
}

void Tracker::miss() {
  if (state_ == TrackingState::kTracking) state_ = TrackingState::kLost;
}

bool Tracker::motion(const Trail &trail, Motion *motion) const {
  if (!has_pose_) return false;
  *motion = {map_, pose_time_ns_, pose_time_ns_, camera_from_map_, trail.covariance(), {}};
  const bool is_found = time_ns_ == pose_time_ns_;
  if (!moved_known_ || is_found) motion->step = trail.step(steady_);
  if (!moved_known_) return true;
  if (!is_found) {
    motion->time_ns = time_ns_;
    motion->camera_from_map = moved_ * camera_from_map_;
    motion->covariance =
        carried(motion->covariance, moved_) + diagonalOf(sqrtOf(moved_rotation2_), sqrtOf(moved_translation2_));
  }
  if (has_step_ && secondsOf(step_ns_) <= kSteadySeconds) {
    const Matrix3 map_from_camera = motion->camera_from_map.rotation.transpose();
    motion->step = {secondsOf(step_ns_), -(map_from_camera * vectorFromRotation(step_.rotation)),
                    -(map_from_camera * step_.translation_m),
                    diagonalOf(odometry_.rotation_sigma_rad, odometry_.translation_sigma_m), is_found ? 0.0 : 1.0};
  }
  return true;
}

}  // namespace sphc
