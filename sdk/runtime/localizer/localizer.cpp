#include "runtime/localizer/localizer.h"

#include "runtime/base/message.h"
#include "runtime/localizer/judgement.h"
#include "runtime/stages/features/gray.h"

namespace sphc {
namespace {

constexpr uint32_t kFewestKeypoints = 32, kFewestLifted = 16, kFewestMatches = 6;
// Half angles of the caps in which a second look is taken, once there is a pose; the first is generous towards it.
constexpr double kCapDegrees[] = {4, 2.5};

FeatureConfig featureConfig(const sphc_config &config) {
  FeatureConfig features;
  features.width = static_cast<int32_t>(config.color_camera.width);
  features.height = static_cast<int32_t>(config.color_camera.height);
  features.max_keypoints = config.max_keypoints;
  return features;
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
  l.lifted_keypoint_ = scratch.take<uint32_t>("localizer.lifted", n);
  l.expected_ = scratch.take<Direction>("localizer.expected", n);
  l.matches_ = scratch.take<Match>("localizer.matches", n);
  l.correspondences_ = scratch.take<Correspondence>("localizer.correspondences", n);
  FeatureExtractor::layout(featureConfig(config), state, scratch, localizer ? &l.extractor_ : nullptr);
  Matcher::layout(n, scratch, localizer ? &l.matcher_ : nullptr);
  PoseEstimator::layout(estimator, scratch, localizer ? &l.estimator_ : nullptr);
}

void Localizer::init(const sphc_config &config, const MapView &map) {
  config_ = config;
  map_ = map;
  const DepthSensor sensor = {config.depth_unit_m, config.depth_min_m, config.depth_max_m, config.depth_sigma_m,
                              config.depth_sigma_per_m2};
  aligner_ = SparseAligner(Camera(config.color_camera), Camera(config.depth_camera),
                           rigidFromDoor(config.color_from_depth), sensor);
  extractor_.init();
}

void Localizer::process(const sphc_frame &frame, sphc_result *result) {
  const int64_t begin = now();
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
    search(result);
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
  lifted_count_ = 0;
  observation_count_ = keypoint_count_;
  for (uint32_t k = 0; k < keypoint_count_; ++k) {
    const Keypoint &keypoint = keypoints_[k];
    observations_[k] = {keypoint.x_px, keypoint.y_px, keypoint.scale_px, 0, 0, 0};
    LiftedPoint lifted;
    double sigma_z = 0;
    if (!aligner_.lift(view, {keypoint.x_px, keypoint.y_px}, &lifted.point_m, &sigma_z)) continue;
    const double z = lifted.point_m.z();
    // coarser keypoints are placed less exactly
    const double pixel =
        config_.pixel_sigma_px * (keypoint.scale_px > 2 ? 0.5 * static_cast<double>(keypoint.scale_px) : 1.0);
    const double across = pixel * z / focal;
    lifted.sideways_m = sqrtOf(across * across + config_.map_sigma_m * config_.map_sigma_m);
    const double along = sigma_z * lifted.point_m.norm() / z;
    lifted.along_m = sqrtOf(along * along + config_.map_sigma_m * config_.map_sigma_m);
    lifted_[lifted_count_] = lifted;
    lifted_keypoint_[lifted_count_] = k;
    descriptors_[lifted_count_] = descriptors_[k];  // the lifted ones move to the front
    ++lifted_count_;
    observations_[k].depth_m = static_cast<float>(z);
    observations_[k].flags = SPHC_OBSERVATION_LIFTED;
  }
}

void Localizer::correspond(uint32_t match_count) {
  match_count_ = match_count;
  for (uint32_t i = 0; i < match_count; ++i) {
    const Direction d = map_.direction(matches_[i].map_index);
    const Match &match = matches_[i];
    correspondences_[i] = {lifted_[match.query],
                           Vector3(static_cast<double>(d.x), static_cast<double>(d.y), static_cast<double>(d.z)),
                           1.0f - static_cast<float>(match.distance2) / static_cast<float>(match.second2 + 1)};
  }
}

void Localizer::search(sphc_result *result) {
  const int64_t begin = now();
  correspond(matcher_.matchAll(map_, descriptors_.first(lifted_count_), config_.max_ratio, matches_));
  const int64_t matched = now();
  result->match_us = static_cast<uint32_t>((matched - begin) / 1000);
  result->matches = match_count_;
  Estimate estimate;
  if (match_count_ < kFewestMatches) {
    result->outcome = SPHC_OUTCOME_FEW_MATCHES;
  } else {
    PoseQuery query;
    query.correspondences = correspondences_.first(match_count_);
    query.seed = config_.seed;
    estimate = estimator_.search(query);
    result->iterations = estimate.iterations;
    result->outcome = SPHC_OUTCOME_NO_CONSENSUS;
    if (estimate.inliers > kFewestMatches / 2) improve(&estimate, result);
  }
  recordMatches();
  if (result->outcome == SPHC_OUTCOME_LOCALIZED) fill(estimate, result);
  result->pose_us = static_cast<uint32_t>((now() - matched) / 1000);
}

// A pose says where in the map each keypoint lies: look there again.  True points that lost the ratio test against
// some distant twin come back, and fakes, which lie anywhere, drop out.
void Localizer::improve(Estimate *estimate, sphc_result *result) {
  Evidence evidence = {};
  evidence.log_chance_first = logChanceOfAgreement(correspondences_.first(match_count_), estimate->camera_from_map,
                                                   estimate->inliers, 3, estimator_.inlierThreshold2(), 4 * kPi) +
                              logOf(static_cast<double>(estimate->iterations));
  double solid_angle_sr = 0;
  for (double cap_degrees : kCapDegrees) {
    const Rigid map_from_camera = estimate->camera_from_map.inverse();
    for (uint32_t i = 0; i < lifted_count_; ++i) {
      const Vector3 d = (map_from_camera * lifted_[i].point_m).normalized();
      expected_[i] = {static_cast<float>(d.x()), static_cast<float>(d.y()), static_cast<float>(d.z())};
    }
    double sine, cosine;
    sinCos(cap_degrees * kPi / 180, &sine, &cosine);
    correspond(matcher_.matchNear(map_, descriptors_.first(lifted_count_), expected_.first(lifted_count_),
                                  static_cast<float>(cosine), config_.max_ratio, matches_));
    solid_angle_sr = 2 * kPi * (1 - cosine);
    const uint32_t iterations = estimate->iterations;
    PoseQuery query;
    query.correspondences = correspondences_.first(match_count_);
    *estimate = estimator_.refine(query, estimate->camera_from_map);
    estimate->iterations = iterations;
  }
  result->matches = match_count_;
  result->inliers = estimate->inliers;
  for (uint32_t i = 0; i < match_count_; ++i)
    if (estimator_.isInlier(correspondences_[i], *estimate))
      observations_[lifted_keypoint_[matches_[i].query]].flags |= SPHC_OBSERVATION_INLIER;
  evidence.inliers = estimate->inliers;
  evidence.log_chance_second =
      logChanceOfAgreement(correspondences_.first(match_count_), estimate->camera_from_map, estimate->inliers, 3,
                           estimator_.inlierThreshold2(), solid_angle_sr);
  result->outcome = judgePose(evidence, *estimate, config_.min_inliers);
}

void Localizer::recordMatches() {
  for (uint32_t i = 0; i < match_count_; ++i) {
    sphc_observation &observation = observations_[lifted_keypoint_[matches_[i].query]];
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
