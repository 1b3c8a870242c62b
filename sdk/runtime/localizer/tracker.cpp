#include "runtime/localizer/tracker.h"

#include <algorithm>

#include "runtime/base/clock.h"
#include "runtime/localizer/hypothesis.h"
#include "runtime/localizer/judgement.h"
#include "runtime/localizer/tuning.h"
#include "runtime/stages/pose/confidence.h"

namespace sphc {
namespace {

using namespace tuning;

bool isVague(const Prediction &expected) {
  return expected.rotation_sigma_rad > kVagueTurnRad || expected.translation_sigma_m > kVagueShiftM;
}

// Beyond what a head does, odometry itself has jumped: its frame is another one now, as after a loop is closed.
bool isOfHead(const Rigid &step, uint64_t took_ns, const Odometry &odometry) {
  const double dt = secondsOf(took_ns);
  return step.translation_m.norm() < kGateSigmas * (kSpeed * dt + odometry.translation_sigma_m) &&
         rotationAngle(step.rotation) < kGateSigmas * (kTurnRate * dt + odometry.rotation_sigma_rad);
}

double shiftSigmaOf(const Rigid &step, const Odometry &odometry) {
  return hypotOf(odometry.translation_sigma_m, odometry.scale_sigma * step.translation_m.norm());
}

}  // namespace

PoseBounds boundsOfNoJump(double rotation_sigma_rad, double translation_sigma_m, const PoseBounds &least) {
  return {least.most_shift_m + kGateSigmas * translation_sigma_m,
          least.most_turn_rad + kGateSigmas * rotation_sigma_rad};
}

CameraRate ofAHead(const CameraRate &measured) {
  const CameraRate any;
  const auto share = [](double any_sigma, double sigma) {
    return any_sigma * any_sigma / (any_sigma * any_sigma + sigma * sigma);
  };
  const double turn = share(any.turn_sigma_rad_s, measured.turn_sigma_rad_s),
               shift = share(any.shift_sigma_m_s, measured.shift_sigma_m_s);
  return {turn * measured.turn_rad_s, shift * measured.shift_m_s, sqrtOf(turn) * measured.turn_sigma_rad_s,
          sqrtOf(shift) * measured.shift_sigma_m_s};
}

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
    has_step_ = isOfHead(step_, step_ns_, *odometry);
  }
  if (has_step_)
    steps_.push({step_, odometry->rotation_sigma_rad, shiftSigmaOf(step_, *odometry)}, step_ns_);
  else
    steps_.clear();
  for (CarriedPose *pose : {&last_, &best_}) {
    pose->is_carried = pose->is_carried && has_step_;
    if (pose->is_carried) pose->carry(step_, *odometry);
  }
  has_odometry_ = odometry != nullptr;
  if (odometry) odometry_ = *odometry;
  time_ns_ = time_ns;
  begun_ = true;
  if (elapsedNs(last_.time_ns, time_ns) > (last_.is_carried ? kForgetCarriedNs : kForgetNs))
    has_pose_ = has_velocity_ = false;
  if (elapsedNs(trusted_time_ns_, time_ns) > kForgetNs) state_ = TrackingState::kRelocalizing;
}

bool Tracker::step(Rigid *now_from_before, double *rotation_sigma_rad, double *translation_sigma_m) const {
  *now_from_before = step_;
  *rotation_sigma_rad = odometry_.rotation_sigma_rad;
  *translation_sigma_m = odometry_.translation_sigma_m;
  return has_step_;
}

bool Tracker::waySince(int64_t then_ns, Way *way) const {
  return then_ns <= time_ns_ ? steps_.wayFromAgo(elapsedNs(then_ns, time_ns_), way)
                             : steps_.wayFromAhead(elapsedNs(time_ns_, then_ns), way);
}

bool Tracker::rate(CameraRate *rate) const {
  constexpr uint64_t kApartNs = 5000000;
  Way way;
  const auto then_ns = static_cast<int64_t>(static_cast<uint64_t>(time_ns_) - kApartNs);  // times may be any
  if (!waySince(then_ns, &way)) return false;
  // The step may have begun and ended at other rates than its own.
  constexpr double kApartS = 1e-9 * kApartNs;
  const double step_s = std::max(secondsOf(step_ns_), kApartS), whole_s = sqrtOf(kApartS * step_s);
  *rate = {vectorFromRotation(way.now_from_then.rotation) / kApartS, way.now_from_then.translation_m / kApartS,
           hypotOf(0.5 * kTurnAcceleration * step_s, way.turn_sigma_rad / whole_s),
           hypotOf(0.5 * kAcceleration * step_s, way.shift_sigma_m / whole_s)};
  return true;
}

bool Tracker::predict(Prediction *prediction) const {
  if (!has_pose_) return false;
  prediction->map = last_.map;
  Rigid moved;
  if (last_.is_carried) {
    moved = last_.moved;
    prediction->rotation_sigma_rad = hypotOf(last_.turnSigma(), rotation_sigma_rad_);
    prediction->translation_sigma_m = hypotOf(last_.shiftSigma(), translation_sigma_m_);
  } else {
    const double dt = secondsOf(elapsedNs(last_.time_ns, time_ns_));
    const Ahead turn = ahead(dt, rotation_sigma_rad_, turn_, kTurnRate, kTurnAcceleration),
                shift = ahead(dt, translation_sigma_m_, shift_, kSpeed, kAcceleration);
    if (turn.is_steady) moved.rotation = rotationFromVector(dt * turn_.a_second);
    if (shift.is_steady) moved.translation_m = dt * shift_.a_second;
    prediction->rotation_sigma_rad = turn.sigma;
    prediction->translation_sigma_m = shift.sigma;
  }
  prediction->camera_from_map = moved * last_.camera_from_map;
  return true;
}

// Of a + r (a - b), where a and b are the poses that a rate is of: a short step says little of a long one.
Tracker::Ahead Tracker::ahead(double dt, double pose_sigma, const StepRate &rate, double most_rate,
                              double acceleration) const {
  const Ahead anyhow = {false, hypotOf(most_rate * dt, pose_sigma)};
  if (!has_velocity_) return anyhow;
  const double r = dt / velocity_s_, accelerated = 0.5 * acceleration * dt * std::max(dt, velocity_s_);
  const double now2 = rate.now * rate.now, before2 = rate.before * rate.before;
  const double of_rate2 = r * r * (now2 + before2) + 2 * r * now2;
  const Ahead steady = {true, sqrtOf(pose_sigma * pose_sigma + of_rate2 + accelerated * accelerated)};
  return steady.sigma < anyhow.sigma ? steady : anyhow;
}

bool Tracker::isSure() const {
  Prediction expected;
  return is_sure_ && predict(&expected) && !isVague(expected);
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
  if (!has_pose_ || !carriedOver({last_.map, last_.camera_from_map, rotation_sigma_rad_, translation_sigma_m_}, map,
                                 maps, &there))
    return;
  last_.map = there.map;
  last_.camera_from_map = there.camera_from_map;
  rotation_sigma_rad_ = there.rotation_sigma_rad;
  translation_sigma_m_ = there.translation_sigma_m;
  went_over_ = true;
}

Jump Tracker::accept(uint32_t map, const Estimate &estimate, double confidence, bool is_doubted, double between_m) {
  Prediction expected;
  Jump jump = jumpTo(map, estimate.camera_from_map, &expected);
  const bool agrees = !jump.events;
  is_sure_ = (agrees && isSure()) || confidence > kSureOfTrack;
  if (agrees && is_sure_ && !is_doubted) {
    state_ = TrackingState::kTracking;
    trusted_time_ns_ = time_ns_;
  } else if (state_ == TrackingState::kTracking) {
    state_ = TrackingState::kLost;
  }
  const double dt = secondsOf(elapsedNs(last_.time_ns, time_ns_));
  // Across maps the error of their transforms is no velocity: the one from before holds.
  const bool is_measured = !went_over_;
  const double rotation_sigma_rad =
      hypotOf(doubtOf(estimate.inliers) * axisSigma(estimate.covariance, 0), kLeastTurnSigma);
  const double translation_sigma_m =
      hypotOf(doubtOf(estimate.inliers) * axisSigma(estimate.covariance, 3), kLeastShiftSigma);
  has_velocity_ = agrees && dt <= kSteadySeconds && (is_measured || has_velocity_);
  if (has_velocity_ && is_measured) {
    const Rigid moved = estimate.camera_from_map * last_.camera_from_map.inverse();
    turn_ = {vectorFromRotation(moved.rotation) / dt, rotation_sigma_rad_, rotation_sigma_rad};
    shift_ = {moved.translation_m / dt, translation_sigma_m_, translation_sigma_m};
    velocity_s_ = dt;
  }
  steady_ = has_velocity_ && is_measured ? steady_ + 1 : 0;
  has_pose_ = true;
  last_ = {map, time_ns_, estimate.camera_from_map, estimate.inliers, true, {}};
  last_.between_m = between_m;
  rotation_sigma_rad_ = rotation_sigma_rad;
  translation_sigma_m_ = translation_sigma_m;
  if (!agrees)
    best_.inliers = 0;
  else if (best_.map != map || estimate.inliers >= support())
    best_ = last_;
  if (went_over_) jump.events |= kMapChanged;
  went_over_ = false;
  return jump;
}

// What is left says nothing without these.
void Tracker::reset() {
  state_ = TrackingState::kRelocalizing;
  begun_ = has_odometry_ = has_step_ = has_pose_ = has_velocity_ = went_over_ = false;
  best_.inliers = steady_ = 0;
  steps_.clear();
}

// In inliers.  What was tracked may have been wrong, so its word fades.
double Tracker::support() const {
  const double age = secondsOf(elapsedNs(best_.time_ns, time_ns_)) / secondsOf(kForgetCarriedNs);
  return age < 1 ? (1 - age) * best_.inliers : 0;
}

// Without odometry by what a head can do, not by the velocity of poses: that of a wrong one is wrong.
bool Tracker::jumpsFrom(const CarriedPose &pose, uint32_t map, const Rigid &found) const {
  if (map != pose.map) return false;
  const double dt = secondsOf(elapsedNs(pose.time_ns, time_ns_));
  const double turn_rad = pose.is_carried ? pose.turnSigma() : kTurnRate * dt,
               shift_m = pose.is_carried ? pose.shiftSigma() : kSpeed * dt;
  return !areNear(found, pose.now(), boundsOfNoJump(turn_rad, hypotOf(shift_m, pose.between_m)));
}

bool Tracker::vetoes(uint32_t map, const Estimate &estimate) const {
  if (estimate.inliers >= kTimesSupport * support()) return false;
  return jumpsFrom(best_, map, estimate.camera_from_map) ||
         (has_pose_ && jumpsFrom(last_, map, estimate.camera_from_map));
}

void Tracker::miss() {
  if (state_ == TrackingState::kTracking) state_ = TrackingState::kLost;
}

bool Tracker::motion(const Trail &trail, Motion *motion) const {
  if (!has_pose_) return false;
  *motion = {last_.map, last_.time_ns, last_.time_ns, last_.camera_from_map, trail.covariance(), {}};
  const bool is_found = time_ns_ == last_.time_ns;
  if (!last_.is_carried || is_found) motion->step = trail.step(steady_);
  if (!last_.is_carried) return true;
  if (!is_found) {
    motion->time_ns = time_ns_;
    motion->camera_from_map = last_.now();
    motion->covariance =
        carried(motion->covariance, last_.moved) + diagonalOf(last_.turnSigma(), last_.shiftSigma());
  }
  if (has_step_ && secondsOf(step_ns_) <= kSteadySeconds) {
    const Matrix3 map_from_camera = motion->camera_from_map.rotation.transpose();
    motion->step = {secondsOf(step_ns_), -(map_from_camera * vectorFromRotation(step_.rotation)),
                    -(map_from_camera * step_.translation_m),
                    diagonalOf(odometry_.rotation_sigma_rad, shiftSigmaOf(step_, odometry_)), is_found ? 0.0 : 1.0};
  }
  return true;
}

}  // namespace sphc
