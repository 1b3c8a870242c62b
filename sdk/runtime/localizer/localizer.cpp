#include "runtime/localizer/localizer.h"

#include <limits>
#include <utility>

#include "runtime/base/message.h"
#include "runtime/localizer/judgement.h"
#include "runtime/stages/features/gray.h"
#include "runtime/stages/pose/confidence.h"

namespace sphc {
namespace {

constexpr uint32_t kFewestKeypoints = 32, kFewestLifted = 16, kFewestMatches = 6;
// Half angles of the caps in which a second look is taken, once there is a pose; the first is generous towards it.
constexpr int kCaps = 2;
constexpr double kCapDegrees[kCaps] = {4, 2.5};
constexpr double kRayM = 1;  // where a keypoint without depth is taken to lie, as far as the map's error goes
constexpr double kUselessSigma = 1e3;  // of a keypoint where the camera model has no bearing
constexpr int kPaperIterations = 25;

FeatureConfig featureConfig(const sphc_config &config) {
  FeatureConfig features;
  features.width = static_cast<int32_t>(config.color_camera.width);
  features.height = static_cast<int32_t>(config.color_camera.height);
  features.max_keypoints = config.max_keypoints;
  return features;
}

double hypotOf(double a, double b) { return sqrtOf(a * a + b * b); }

Vector3 vectorOf(const double v[3]) { return Vector3(v[0], v[1], v[2]); }

PosePrior priorFromDoor(const sphc_prior *given) {
  PosePrior prior;
  if (!given) return prior;
  prior.has_pose = given->flags & SPHC_PRIOR_POSE;
  if (prior.has_pose) {
    prior.camera_from_map = rigidFromDoor(given->camera_from_map);
    prior.rotation_sigma_rad = given->rotation_sigma_rad;
    prior.translation_sigma_m = given->translation_sigma_m;
  }
  prior.has_up = given->flags & SPHC_PRIOR_UP;
  if (prior.has_up) {
    prior.up_camera = vectorOf(given->up_camera).normalized();
    prior.up_map = vectorOf(given->up_map).normalized();
    prior.up_sigma_rad = given->up_sigma_rad;
  }
  return prior;
}

// Until the second look has judged a pose that was found.
sphc_outcome outcomeOf(PoseEnding ending) {
  if (ending == PoseEnding::kFewCorrespondences) return SPHC_OUTCOME_FEW_MATCHES;
  return ending == PoseEnding::kDeadline ? SPHC_OUTCOME_DEADLINE : SPHC_OUTCOME_NO_CONSENSUS;
}

}  // namespace

void Localizer::layout(const sphc_config &config, Arena &state, Arena &scratch, Localizer *localizer) {
  const uint32_t n = config.max_keypoints;
  const size_t pixels = size_t{config.color_camera.width} * config.color_camera.height;
  EstimatorConfig estimator;
  estimator.capacity = n;
  estimator.max_iterations = config.max_iterations;

  Localizer discarded;  // receives empty spans while measuring
  Localizer &l = localizer ? *localizer : discarded;
  l.observations_ = state.take<sphc_observation>("localizer.observations", n);
  l.gray_ = scratch.take<uint8_t>("localizer.gray", pixels);
  l.keypoints_ = scratch.take<Keypoint>("localizer.keypoints", n);
  l.descriptors_ = scratch.take<Descriptor>("localizer.descriptors", n);
  l.lifted_ = scratch.take<LiftedPoint>("localizer.lifted", n);
  l.keypoint_of_ = scratch.take<uint32_t>("localizer.lifted", n);
  l.expected_ = scratch.take<Direction>("localizer.expected", n);
  l.matches_ = scratch.take<Match>("localizer.matches", n);
  l.ray_matches_ = scratch.take<Match>("localizer.matches", n);
  l.correspondences_ = scratch.take<Correspondence>("localizer.correspondences", n);
  SparseAligner::layout(static_cast<int32_t>(config.depth_camera.width),
                        static_cast<int32_t>(config.depth_camera.height), scratch,
                        localizer ? &l.aligner_ : nullptr);
  FeatureExtractor::layout(featureConfig(config), state, scratch, localizer ? &l.extractor_ : nullptr);
  Matcher::layout(n, scratch, localizer ? &l.matcher_ : nullptr);
  PoseEstimator::layout(estimator, scratch, localizer ? &l.estimator_ : nullptr);
}

void Localizer::init(const sphc_config &config, const MapView &map) {
  config_ = config;
  map_ = map;
  const DepthSensor sensor = {config.depth_unit_m, config.depth_min_m, config.depth_max_m, config.depth_sigma_m,
                              config.depth_sigma_per_m2};
  aligner_.init(Camera(config.color_camera), Camera(config.depth_camera), rigidFromDoor(config.color_from_depth),
                sensor);
  extractor_.init();
  DepthCalibration prior;
  prior.mid_m = config.depth_mid_m > 0 ? config.depth_mid_m : sqrtOf(config.depth_min_m * config.depth_max_m);
  prior.covariance(0, 0) = config.depth_offset_sigma_m * config.depth_offset_sigma_m;
  prior.covariance(1, 1) = config.depth_slope_sigma * config.depth_slope_sigma;
  calibrator_.init(prior);
}

void Localizer::process(const sphc_frame &frame, sphc_result *result) {
  const int64_t begin = now();
  recordDepth(result);
  extract(frame.color);
  const int64_t extracted = now();
  lift(frame.depth);
  const int64_t aligned = now();
  result->keypoints = keypoint_count_;
  result->lifted = lifted_count_;
  result->features_us = static_cast<uint32_t>((extracted - begin) / 1000);
  result->align_us = static_cast<uint32_t>((aligned - extracted) / 1000);
  if (keypoint_count_ < kFewestKeypoints)
    result->outcome = SPHC_OUTCOME_FEW_KEYPOINTS;
  else if (lifted_count_ < kFewestLifted)
    result->outcome = SPHC_OUTCOME_FEW_DEPTHS;
  else
    search(frame.prior, {config_.clock, config_.clock_user, begin + int64_t{config_.deadline_us} * 1000}, result);
  log(*result);
}

void Localizer::extract(const sphc_image &color) {
  const auto *pixels = static_cast<const uint8_t *>(color.data);
  GrayView gray = {pixels, static_cast<int32_t>(color.width), static_cast<int32_t>(color.height),
                   static_cast<int32_t>(color.stride_bytes)};
  if (color.format != SPHC_FORMAT_GRAY8) {
    const auto convert = color.format == SPHC_FORMAT_RGB8 ? rgbToGray : bgrToGray;
    convert(pixels, gray.stride, gray.width, gray.height, gray_.data(), gray.width);
    gray.data = gray_.data();
    gray.stride = gray.width;
  }
  keypoint_count_ = extractor_.extract(gray, keypoints_, descriptors_);
}

void Localizer::lift(const sphc_image &depth) {
  const ImageView<uint16_t> view = {static_cast<const uint16_t *>(depth.data), static_cast<int32_t>(depth.width),
                                    static_cast<int32_t>(depth.height),
                                    static_cast<int32_t>(depth.stride_bytes / 2)};
  const double focal = 0.5 * (config_.color_camera.params[0] + config_.color_camera.params[1]);
  aligner_.prepare(view);
  lifted_count_ = 0;
  observation_count_ = keypoint_count_;
  for (uint32_t k = 0; k < keypoint_count_; ++k) {
    const Keypoint &keypoint = keypoints_[k];
    observations_[k] = {keypoint.x_px, keypoint.y_px, keypoint.scale_px, 0, 0, 0};
    // coarser keypoints are placed less exactly
    const double pixel =
        config_.pixel_sigma_px * (keypoint.scale_px > 2 ? 0.5 * static_cast<double>(keypoint.scale_px) : 1.0);
    keypoint_of_[k] = k;
    lifted_[k] = {Vector3::UnitZ(), kUselessSigma, std::numeric_limits<double>::infinity()};
    if (aligner_.bearing({keypoint.x_px, keypoint.y_px}, &lifted_[k].point_m))
      lifted_[k].sideways_m = hypotOf(pixel / focal, config_.map_sigma_m / kRayM);
    double sigma_z = 0;
    Vector3 point_m;
    if (!aligner_.lift(view, {keypoint.x_px, keypoint.y_px}, &point_m, &sigma_z)) continue;
    const double z = point_m.z();
    lifted_[k] = {point_m, hypotOf(pixel * z / focal, config_.map_sigma_m),
                  hypotOf(sigma_z * point_m.norm() / z, config_.map_sigma_m)};
    observations_[k].depth_m = static_cast<float>(z);
    observations_[k].flags = SPHC_OBSERVATION_LIFTED;
    toFront(k);
  }
}

// Makes keypoint k, the last so far, one of those with depth, which come first.
void Localizer::toFront(uint32_t k) {
  std::swap(lifted_[lifted_count_], lifted_[k]);
  std::swap(keypoint_of_[lifted_count_], keypoint_of_[k]);
  std::swap(descriptors_[lifted_count_], descriptors_[k]);
  ++lifted_count_;
}

Span<const Correspondence> Localizer::correspond(uint32_t match_count) {
  match_count_ = match_count;
  for (uint32_t i = 0; i < match_count; ++i) {
    const Match &match = matches_[i];
    const Direction d = map_.direction(match.map_index);
    correspondences_[i] = {lifted_[match.query],
                           Vector3(static_cast<double>(d.x), static_cast<double>(d.y), static_cast<double>(d.z)),
                           1.0f - static_cast<float>(match.distance2) / static_cast<float>(match.second2 + 1)};
  }
  return correspondences_.first(match_count);
}

void Localizer::search(const sphc_prior *given, const Deadline &deadline, sphc_result *result) {
  const int64_t begin = now();
  const bool paper = config_.cost == SPHC_COST_PAPER;  // it knows neither keypoints without depth nor priors
  const uint32_t asked = paper ? lifted_count_ : keypoint_count_;
  PoseQuery query;
  query.correspondences =
      correspond(matcher_.matchAll(map_, descriptors_.first(asked), config_.max_ratio, matches_));
  const int64_t matched = now();
  result->match_us = static_cast<uint32_t>((matched - begin) / 1000);
  result->matches = match_count_;
  const PosePrior prior = priorFromDoor(paper ? nullptr : given);
  query.prior = &prior;
  query.depth = calibrator_.current();
  query.seed = config_.seed;
  if (config_.deadline_us) query.deadline = deadline;
  Estimate searched, estimate;
  result->outcome = SPHC_OUTCOME_FEW_MATCHES;
  if (match_count_ >= kFewestMatches) {
    estimate = searched = firstPose(query);
    result->iterations = estimate.iterations;
    result->cut_short = estimate.cut_short;
    result->outcome = outcomeOf(estimate.ending);
    if (estimate.inliers > kFewestMatches / 2) improve(query, &estimate, result);
  }
  recordMatches();
  if (result->outcome == SPHC_OUTCOME_LOCALIZED) {
    fill(estimate, result);
    result->confidence = confidenceOf(confidenceInputs(searched, estimate));
    if (!paper) calibrator_.learn(estimate);
  }
  result->pose_us = static_cast<uint32_t>((now() - matched) / 1000);
}

PaperCostConfig Localizer::paperConfig() const {
  PaperCostConfig paper;
  paper.focal_px = 0.5 * (config_.color_camera.params[0] + config_.color_camera.params[1]);
  paper.max_iterations = config_.max_iterations;
  return paper;
}

Estimate Localizer::firstPose(const PoseQuery &query) {
  if (config_.cost == SPHC_COST_WHITENED) return estimator_.search(query);
  const Estimate found = estimateWithPaperCost(paperConfig(), query.correspondences, query.seed);
  if (found.inliers == 0) return found;
  Estimate estimate = estimator_.evaluate(query, found.camera_from_map);
  estimate.iterations = found.iterations;
  return estimate;
}

Estimate Localizer::refined(const PoseQuery &query, const Rigid &camera_from_map) {
  if (config_.cost == SPHC_COST_WHITENED) return estimator_.refine(query, camera_from_map);
  const Rigid pose = refineWithPaperCost(paperConfig(), query.correspondences, camera_from_map, kPaperIterations);
  return estimator_.evaluate(query, pose);
}

// Matches of keypoints without depth are those of the first look: without depth a pose does not say where to look.
void Localizer::keepRays() {
  ray_match_count_ = 0;
  for (uint32_t i = 0; i < match_count_; ++i)
    if (matches_[i].query >= lifted_count_) ray_matches_[ray_match_count_++] = matches_[i];
}

// Matches each lifted keypoint near where the pose says it lies.
uint32_t Localizer::matchAgain(const Rigid &camera_from_map, double cap_rad) {
  const Rigid map_from_camera = camera_from_map.inverse();
  for (uint32_t i = 0; i < lifted_count_; ++i) {
    const Vector3 d = (map_from_camera * lifted_[i].point_m).normalized();
    expected_[i] = {static_cast<float>(d.x()), static_cast<float>(d.y()), static_cast<float>(d.z())};
  }
  double sine, cosine;
  sinCos(cap_rad, &sine, &cosine);
  uint32_t count = matcher_.matchNear(map_, descriptors_.first(lifted_count_), expected_.first(lifted_count_),
                                      static_cast<float>(cosine), config_.max_ratio, matches_);
  for (uint32_t i = 0; i < ray_match_count_; ++i) matches_[count++] = ray_matches_[i];
  return count;
}

// A pose says where in the map each keypoint lies: look there again.  True points that lost the ratio test against
// some distant twin come back, and fakes, which lie anywhere, drop out.
void Localizer::improve(const PoseQuery &first, Estimate *estimate, sphc_result *result) {
  Evidence evidence = {};
  const double threshold2 = estimator_.inlierThreshold2();
  evidence.log_chance_first =
      logChanceOfAgreement(first.correspondences, estimate->camera_from_map, estimate->inliers, 3,
                           first.depth.noise_scale, threshold2, 4 * kPi) +
      logOf(static_cast<double>(estimate->iterations) + 1);
  keepRays();
  PoseQuery query = first;
  for (double cap_degrees : kCapDegrees) {
    query.correspondences = correspond(matchAgain(estimate->camera_from_map, cap_degrees * kPi / 180));
    const Estimate before = *estimate;
    *estimate = refined(query, before.camera_from_map);
    estimate->iterations = before.iterations;
    estimate->cut_short = before.cut_short;
  }
  result->matches = match_count_;
  result->inliers = estimate->inliers;
  for (uint32_t i = 0; i < match_count_; ++i)
    if (estimator_.isInlier(correspondences_[i], *estimate))
      observations_[keypoint_of_[matches_[i].query]].flags |= SPHC_OBSERVATION_INLIER;
  evidence.inliers = estimate->inliers;
  double sine, cosine;
  sinCos(kCapDegrees[kCaps - 1] * kPi / 180, &sine, &cosine);
  evidence.log_chance_second =
      logChanceOfAgreement(query.correspondences, estimate->camera_from_map, estimate->inliers, 3,
                           first.depth.noise_scale, threshold2, 2 * kPi * (1 - cosine));
  result->outcome = judgePose(evidence, *estimate, config_.min_inliers);
}

void Localizer::recordMatches() {
  for (uint32_t i = 0; i < match_count_; ++i) {
    sphc_observation &observation = observations_[keypoint_of_[matches_[i].query]];
    observation.map_index = matches_[i].map_index;
    observation.flags |= SPHC_OBSERVATION_MATCHED;
  }
}

void Localizer::fill(const Estimate &estimate, sphc_result *result) const {
  result->camera_from_map = doorFromRigid(estimate.camera_from_map);
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 6; ++column)
      result->covariance[6 * row + column] = estimate.covariance(row, column);
}

void Localizer::recordDepth(sphc_result *result) const {
  const DepthCalibration &depth = calibrator_.current();
  result->depth = {depth.mid_m,
                   depth.mean[0],
                   depth.mean[1],
                   sqrtOf(depth.covariance(0, 0)),
                   sqrtOf(depth.covariance(1, 1)),
                   depth.noise_scale};
}

void Localizer::log(const sphc_result &result) const {
  if (!config_.log) return;
  sphc_message text;
  MessageWriter(&text) << "frame " << result.sequence << ": "
                       << (result.outcome == SPHC_OUTCOME_LOCALIZED ? "localized" : "not localized") << ", outcome "
                       << result.outcome << ", keypoints " << result.keypoints << ", lifted " << result.lifted
                       << ", matches " << result.matches << ", inliers " << result.inliers;
  size_t length = 0;
  while (text.text[length]) ++length;
  config_.log(config_.log_user, SPHC_LOG_DEBUG, text.text, length);
}

}  // namespace sphc
