#include "runtime/capi/translate.h"

#include <algorithm>

#include "runtime/capi/format.h"

namespace sphc {
namespace {

Vector3 vectorFrom(const double v[3]) { return Vector3(v[0], v[1], v[2]); }

double signedSeconds(int64_t ns) { return 1e-9 * static_cast<double>(ns); }

uint32_t microseconds(uint64_t ns) { return static_cast<uint32_t>(std::min<uint64_t>(ns / 1000, UINT32_MAX)); }

DepthCalibration depthPriorFrom(const sphc_localizer_config &config) {
  DepthCalibration prior;
  prior.mid_m = config.depth_mid_m > 0 ? config.depth_mid_m : sqrtOf(config.depth_min_m * config.depth_max_m);
  prior.covariance(0, 0) = config.depth_offset_sigma_m * config.depth_offset_sigma_m;
  prior.covariance(1, 1) = config.depth_slope_sigma * config.depth_slope_sigma;
  return prior;
}

PosePrior posePriorFrom(const sphc_localizer_prior &given) {
  PosePrior prior;
  prior.has_pose = given.flags & SPHC_PRIOR_POSE;
  if (prior.has_pose) {
    prior.camera_from_map = rigidFromC(given.camera_from_map);
    prior.rotation_sigma_rad = given.rotation_sigma_rad;
    prior.translation_sigma_m = given.translation_sigma_m;
  }
  prior.has_up = given.flags & SPHC_PRIOR_UP;
  if (prior.has_up) {
    prior.up_camera = vectorFrom(given.up_camera).normalized();
    prior.up_map = vectorFrom(given.up_map).normalized();
    prior.up_sigma_rad = given.up_sigma_rad;
  }
  return prior;
}

Known knownFrom(const sphc_localizer_prior &given, const MapSet &maps) {
  Known known;
  known.map = maps.slotOf(given.map_id);
  known.prior = posePriorFrom(given);
  known.has_odometry = given.flags & SPHC_PRIOR_ODOMETRY;
  if (known.has_odometry) {
    known.odometry = {rigidFromC(given.odometry_from_camera), given.odometry_rotation_sigma_rad,
                      given.odometry_translation_sigma_m};
  }
  return known;
}

FurtherView viewFrom(const sphc_localizer_view &view) {
  FurtherView own;
  own.image = colorViewFrom(view.image);
  own.time_ns = view.time_ns;
  if (view.camera) own.camera = Camera(*view.camera);
  if (view.color_from_camera) own.color_from_camera = rigidFromC(*view.color_from_camera);
  return own;
}

RigDepthCamera depthCameraFrom(const sphc_localizer_depth_camera &camera) {
  return {Camera(camera.camera),
          rigidFromC(camera.color_from_depth),
          sensorReadAs(camera.format, depthSensorFrom(camera)),
          depthLayoutFrom(camera.format),
          camera.amplitude_min,
          Vector2(camera.offset_sigma_m, camera.slope_sigma)};
}

DepthView depthViewFrom(const sphc_image &depth, const sphc_image &amplitude, int64_t time_ns,
                        const sphc_camera *camera, const sphc_rigid *color_from_depth) {
  DepthView own;
  own.depth = bytesOf(depth);
  if (amplitude.data)
    own.amplitude = {bytesOf(amplitude), static_cast<int32_t>(sphc_format_bytes(amplitude.format))};
  own.time_ns = time_ns;
  if (camera) own.camera = Camera(*camera);
  if (color_from_depth) own.color_from_depth = rigidFromC(*color_from_depth);
  return own;
}

void fillCovariance(const Matrix6 &own, double row_major[36]) {
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 6; ++column) row_major[6 * row + column] = own(row, column);
}

sphc_depth_bias depthBiasFrom(const DepthCalibration &depth) {
  const double offset_sigma_m = sqrtOf(depth.covariance(0, 0)), slope_sigma = sqrtOf(depth.covariance(1, 1));
  const double correlation = depth.isKnown() ? 0 : depth.covariance(0, 1) / (offset_sigma_m * slope_sigma);
  return {depth.mid_m, depth.mean[0], depth.mean[1], offset_sigma_m, slope_sigma, correlation, depth.noise_scale};
}

}  // namespace

DepthSensor depthSensorFrom(const sphc_localizer_config &c) {
  return {c.rig.depth_unit_m, c.depth_min_m, c.depth_max_m, c.depth_sigma_m, c.depth_sigma_per_m2};
}

DepthSensor depthSensorFrom(const sphc_localizer_depth_camera &c) {
  return {c.unit_m, c.min_m, c.max_m, c.sigma_m, c.sigma_per_m2};
}

// Metres beyond 16 bits of units become 65535 of them, which so is farther than what counts.
DepthSensor sensorReadAs(sphc_format format, DepthSensor sensor) {
  if (depthLayoutFrom(format).kind == DepthLayout::kMetres)
    sensor.max_m = std::min(sensor.max_m, 65534.5 * sensor.unit_m);
  return sensor;
}

DepthCalibration depthCalibrationFrom(const sphc_depth_bias &depth) {
  DepthCalibration own;
  own.mid_m = depth.mid_m;
  own.mean = Vector2(depth.offset_m, depth.slope);
  const double shared = depth.correlation * (depth.offset_sigma_m * depth.slope_sigma);  // as depthBiasFrom divides
  own.covariance << depth.offset_sigma_m * depth.offset_sigma_m, shared, shared,
      depth.slope_sigma * depth.slope_sigma;
  own.noise_scale = depth.noise_scale;
  return own;
}

LocalizerConfig localizerConfigFrom(const sphc_localizer_config &config) {
  LocalizerConfig own;
  own.max_keypoints = config.max_keypoints;
  own.max_maps = config.max_maps;
  own.seed = config.seed;
  own.tracks = config.mode == SPHC_MODE_TRACKING;
  own.color_camera = Camera(config.rig.color_camera);
  for (uint32_t i = 0; i < config.camera_count; ++i)
    own.further.push({Camera(config.cameras[i].camera), rigidFromC(config.cameras[i].color_from_camera),
                      signedSeconds(config.cameras[i].row_time_ns)});
  own.color_row_time_s = signedSeconds(config.color_row_time_ns);
  own.depth.push({Camera(config.rig.depth_camera), rigidFromC(config.rig.color_from_depth),
                  sensorReadAs(config.depth_format, depthSensorFrom(config)), depthLayoutFrom(config.depth_format),
                  config.amplitude_min});
  for (uint32_t i = 0; i < config.depth_camera_count; ++i) own.depth.push(depthCameraFrom(config.depth_cameras[i]));
  own.depth_prior = depthPriorFrom(config);
  own.pixel_sigma_px = config.pixel_sigma_px;
  own.map_sigma_m = config.map_sigma_m;
  own.clock = {config.clock, config.clock_user};
  if (config.parallel) own.parallel = {config.parallel, config.parallel_user, config.parallel_tasks};
  return own;
}

FrameInput frameFrom(const sphc_localizer_frame &frame, const MapSet &maps) {
  FrameInput own;
  own.color_time_ns = frame.color_time_ns;
  own.color = colorViewFrom(frame.color);
  own.depth.push(
      depthViewFrom(frame.depth, frame.amplitude, frame.depth_time_ns, frame.depth_camera, frame.color_from_depth));
  for (uint32_t i = 0; i < frame.depth_view_count; ++i) {
    const sphc_localizer_depth_view &view = frame.depth_views[i];
    own.depth.push(depthViewFrom(view.depth, view.amplitude, view.time_ns, view.camera, view.color_from_depth));
  }
  if (frame.prior) own.known = knownFrom(*frame.prior, maps);
  own.time_limit_ns = int64_t{frame.deadline_us} * 1000;
  if (frame.color_camera) own.color_camera = Camera(*frame.color_camera);
  for (uint32_t i = 0; i < frame.view_count; ++i) own.further.push(viewFrom(frame.views[i]));
  return own;
}

ColorView colorViewFrom(const sphc_image &image) { return {bytesOf(image), pixelFormatOf(image.format).luma}; }

ByteView bytesOf(const sphc_image &image) {
  return {static_cast<const uint8_t *>(image.data), static_cast<int32_t>(image.width),
          static_cast<int32_t>(image.height), static_cast<int32_t>(image.stride_bytes)};
}

DepthLayout depthLayoutFrom(sphc_format format) { return pixelFormatOf(depthFormatOf(format)).depth; }

sphc_localizer_outcome outcomeFrom(Outcome outcome) {
  switch (outcome) {
    case Outcome::kLocalized:
      return SPHC_OUTCOME_LOCALIZED;
    case Outcome::kFewKeypoints:
      return SPHC_OUTCOME_FEW_KEYPOINTS;
    case Outcome::kFewDepths:
      return SPHC_OUTCOME_FEW_DEPTHS;
    case Outcome::kFewMatches:
      return SPHC_OUTCOME_FEW_MATCHES;
    case Outcome::kNoConsensus:
      return SPHC_OUTCOME_NO_CONSENSUS;
    case Outcome::kUncertain:
      return SPHC_OUTCOME_UNCERTAIN;
    case Outcome::kDeadline:
      return SPHC_OUTCOME_DEADLINE;
    case Outcome::kContradiction:
      return SPHC_OUTCOME_CONTRADICTION;
  }
  return SPHC_OUTCOME_NO_CONSENSUS;  // never
}

// The bits are the interface's.
static_assert(kDepthRange == SPHC_FAULT_DEPTH_RANGE && kDepthConstant == SPHC_FAULT_DEPTH_CONSTANT &&
              kDepthBent == SPHC_FAULT_DEPTH_BENT && kDepthFrozen == SPHC_FAULT_DEPTH_FROZEN &&
              kColorFrozen == SPHC_FAULT_COLOR_FROZEN && kDepthColorDisagree == SPHC_FAULT_DEPTH_COLOR_DISAGREE &&
              kDepthScale == SPHC_FAULT_DEPTH_SCALE && kDepthBias == SPHC_FAULT_DEPTH_BIAS &&
              kVerticalDisagrees == SPHC_FAULT_VERTICAL_DISAGREES && kMirrored == SPHC_FAULT_MIRRORED &&
              kDistancesDisagree == SPHC_FAULT_DISTANCES_DISAGREE &&
              kOdometryDisagrees == SPHC_FAULT_ODOMETRY_DISAGREES && kFocalDisagrees == SPHC_FAULT_FOCAL_DISAGREES);
static_assert(kCutFeatures == SPHC_CUT_FEATURES && kCutMatches == SPHC_CUT_MATCHES &&
              kCutSearch == SPHC_CUT_SEARCH && kCutVerification == SPHC_CUT_VERIFICATION);
static_assert(kTooDark == SPHC_HINT_TOO_DARK && kTooFast == SPHC_HINT_TOO_FAST &&
              kTooPlain == SPHC_HINT_TOO_PLAIN && kNoDepthInRange == SPHC_HINT_NO_DEPTH_IN_RANGE &&
              kNotInMap == SPHC_HINT_NOT_IN_MAP && kAmbiguous == SPHC_HINT_AMBIGUOUS);
static_assert(kRelocalized == SPHC_EVENT_RELOCALIZED && kJumped == SPHC_EVENT_JUMPED &&
              kMapChanged == SPHC_EVENT_MAP_CHANGED);

sphc_localizer_state stateFrom(TrackingState state) {
  switch (state) {
    case TrackingState::kRelocalizing:
      return SPHC_STATE_RELOCALIZING;
    case TrackingState::kTracking:
      return SPHC_STATE_TRACKING;
    case TrackingState::kLost:
      return SPHC_STATE_LOST;
  }
  return SPHC_STATE_RELOCALIZING;  // never
}

sphc_localizer_observation observationFrom(const Observation &o) {
  uint32_t flags = 0;
  if (o.lifted) flags |= SPHC_OBSERVATION_LIFTED;
  if (o.matched) flags |= SPHC_OBSERVATION_MATCHED;
  if (o.inlier) flags |= SPHC_OBSERVATION_INLIER;
  return {o.x_px, o.y_px, o.scale_px, o.depth_m, o.point_index, flags, o.camera};
}

sphc_localizer_hypothesis hypothesisFrom(const RankedPose &pose) {
  return {pose.map_id,    outcomeFrom(pose.outcome),      pose.inliers,
          pose.is_answer, rigidToC(pose.camera_from_map), pose.gain,
          pose.log_chance};
}

sphc_localizer_result resultFrom(const LocalizerResult &answer, const sphc_localizer_frame &frame) {
  sphc_localizer_result result = {};
  result.struct_size = sizeof result;
  result.sequence = frame.sequence;
  result.time_ns = frame.color_time_ns;
  result.outcome = outcomeFrom(answer.outcome);
  result.keypoints = answer.keypoints;
  result.lifted = answer.lifted;
  result.matches = answer.matches;
  result.inliers = answer.inliers;
  result.iterations = answer.samples;
  result.camera_from_map.q_wxyz[0] = 1;
  if (answer.outcome == Outcome::kLocalized) result.camera_from_map = rigidToC(answer.camera_from_map);
  fillCovariance(answer.covariance, result.covariance);
  result.features_us = microseconds(answer.times.features_ns);
  result.align_us = microseconds(answer.times.align_ns);
  result.match_us = microseconds(answer.times.match_ns);
  result.pose_us = microseconds(answer.times.pose_ns);
  result.confidence = answer.confidence;
  result.cuts = answer.cuts;
  result.state = stateFrom(answer.state);
  result.map_id = answer.map_id;
  result.frames = answer.frames;
  result.guided = answer.guided;
  result.faults = answer.faults;
  result.hints = answer.hints;
  result.depth = depthBiasFrom(answer.depth);
  result.events = answer.jump.events;
  result.jump_m = answer.jump.shift_m;
  result.jump_rad = answer.jump.turn_rad;
  return result;
}

sphc_localizer_prediction predictionFrom(const MovedPose &moved, uint32_t map_id) {
  sphc_localizer_prediction prediction = {};
  prediction.map_id = map_id;
  prediction.pose_time_ns = moved.pose_time_ns;
  prediction.camera_from_map = rigidToC(moved.camera_from_map);
  fillCovariance(moved.covariance, prediction.covariance);
  for (int i = 0; i < 3; ++i) {
    prediction.velocity_in_map_m_s[i] = moved.velocity_in_map_m_s[i];
    prediction.angular_velocity_in_map_rad_s[i] = moved.angular_velocity_in_map_rad_s[i];
  }
  prediction.velocity_sigma_m_s = moved.velocity_sigma_m_s;
  prediction.angular_velocity_sigma_rad_s = moved.angular_velocity_sigma_rad_s;
  return prediction;
}

}  // namespace sphc
