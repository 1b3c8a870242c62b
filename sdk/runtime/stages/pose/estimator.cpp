#include "runtime/stages/pose/estimator.h"

#include <algorithm>

#include "runtime/stages/pose/mirrored.h"
#include "runtime/stages/pose/residual.h"
#include "runtime/stages/pose/symmetric.h"

namespace sphc {
namespace {

constexpr uint32_t kFewestRows = 4;
// Under a deadline: rows that are scored between two looks at the clock; rows that a sample costs beside its
// scores.
constexpr uint32_t kGrain = 2048, kSampling = 256;
constexpr double kMinimalThreshold2 = 30;  // minimal samples carry the noise of three points
constexpr float kLocalLimit2 = 150;        // rows that local optimisation uses
constexpr float kFinalLimit2 = 60;         // rows that the final refinement uses
constexpr int kLocalSteps = 2, kFinalIterations = 12;
constexpr double kLocalScale2 = 16;  // of the Geman-McClure loss
// Wald's test on the gain seen so far: shares of the rows that a right pose gains at least, and slack in rows.
constexpr float kLeastShare = 0.04f, kShareOfBest = 0.35f, kSlack = 2.0f;
// Share of the rows that agree by chance, at least; log of the odds that make an agreement certain.
constexpr double kLeastChance = 0.005, kCertain = 25;
// Of the samples without an outlier, those that are exact enough to lead to the pose.
constexpr double kUsefulSamples = 0.5;
constexpr double kMissOnceCertain = 0.5;  // of a better sample than the one that led to a certain agreement
constexpr double kGateSigmas = 4;         // beyond it a pose is not the expected one
constexpr float kVerifiedGain = 10, kVerifiedShare = 0.1f;  // an expected pose with this much support is the pose
constexpr uint32_t kSmallSearch = 8;                        // near an expected pose: this part of the iterations
// For the noise of depth: rows that agree with their epipolar plane so well, and whose squared error along the ray
// is this many times what pixels bring.
constexpr float kAgreeingPlane2 = 4;
constexpr double kMostlyDepth = 4, kMedianOfSquare = 0.4549;
constexpr uint32_t kFewestForNoise = 16;
constexpr double kResidualFreedom = 2, kExpectedInliers = 4;  // degrees of a residual; weight of what is expected

// A rotation again, after many small turns in finite precision.
Rigid cleaned(const Rigid &pose) {
  double q[4];
  quaternionFromRotation(pose.rotation, q);
  return {rotationFromQuaternion(q), pose.translation_m};
}

// Any rotation that takes `up` to z.
void uprightFrom(const Vector3 &up, float *upright_from_frame) {
  const Vector3 helper = absOf(up.x()) < 0.7 ? Vector3::UnitX() : Vector3::UnitY();
  const Vector3 x = helper.cross(up).normalized(), y = up.cross(x);
  for (int k = 0; k < 3; ++k) {
    upright_from_frame[k] = static_cast<float>(x[k]);
    upright_from_frame[3 + k] = static_cast<float>(y[k]);
    upright_from_frame[6 + k] = static_cast<float>(up[k]);
  }
}

uint32_t stepThrough(uint32_t count) {
  uint32_t step = static_cast<uint32_t>(0.6180339887 * count) | 1u;
  const auto coprime = [count](uint32_t a) {
    uint32_t b = count;
    while (b) {
      const uint32_t rest = a % b;
      a = b;
      b = rest;
    }
    return a == 1;
  };
  while (count > 1 && !coprime(step)) ++step;
  return count > 1 ? step % count : 0;
}

uint32_t sampleSize(const PoseQuery &query) { return query.prior && query.prior->has_up ? 2 : 3; }

}  // namespace

void PoseEstimator::layout(const EstimatorConfig &config, Arena &scratch, PoseEstimator *estimator) {
  PoseEstimator discarded;
  PoseEstimator &e = estimator ? *estimator : discarded;
  const uint32_t padded = (config.capacity + kPoseChunk - 1) / kPoseChunk * kPoseChunk;
  Sampler::layout(config.capacity, scratch, estimator ? &e.sampler_ : nullptr);
  const auto takeRows = [&](const char *name, PoseRows *rows) {
    PoseRows::layout(name, config.capacity, config.has_centres, scratch, estimator ? rows : nullptr);
  };
  takeRows("pose.lifted", &e.lifted_);
  takeRows("pose.planes", &e.planes_);
  takeRows("pose.near", &e.near_);
  takeRows("pose.near", &e.near_planes_);
  e.squared_ = scratch.take<float>("pose.squared", padded);
  e.plane_squared_ = scratch.take<float>("pose.squared", padded);
  e.quality_ = scratch.take<float>("pose.order", config.capacity);
  e.kept_ = scratch.take<uint32_t>("pose.order", config.capacity);
  e.batch_ = scratch.take<MinimalBatch>("pose.samples", 1).data();
  e.poses_ = scratch.take<PoseBatch>("pose.samples", 1).data();
  e.config_ = config;
  e.kernels_ = config.kernels ? config.kernels : &simdPoseKernels();
}

// Moves lifted rows far from where they were: any first part of them is then a fair sample, whatever the order was.
// Steps of the golden ratio, made coprime to the count, visit every place once.
void PoseEstimator::load(const PoseQuery &query) {
  lifted_.count = planes_.count = 0;
  for (const Correspondence &c : query.correspondences) ++(c.lifted.hasDepth() ? lifted_ : planes_).count;
  const uint32_t count = lifted_.count, step = stepThrough(count);
  uint32_t place = count ? static_cast<uint32_t>(query.seed % count) : 0, plane = 0;
  for (const Correspondence &c : query.correspondences) {
    if (!c.lifted.hasDepth()) {
      planes_.set(plane++, c);
      continue;
    }
    lifted_.set(place, c);
    quality_[place] = c.quality;
    place += step;
    if (place >= count) place -= count;
  }
  const DepthCorrection correction = {
      static_cast<float>(query.depth.mean[0]), static_cast<float>(query.depth.mean[1]),
      static_cast<float>(query.depth.mid_m), static_cast<float>(query.depth.noise_scale)};
  for (PoseRows *rows : {&lifted_, &planes_}) {
    rows->pad();
    kernels_->prepare(rows, correction);
  }
}

float PoseEstimator::gainOf(const Rigid &pose, double threshold2) const {
  const ScoreLimits limits = {static_cast<float>(1 / threshold2), -1.0f, 0.0f, 0.0f};
  return kernels_->score(lifted_, poseF(pose), limits).gain;
}

void PoseEstimator::keepNear(const RefineTask &task, const Rigid &pose, float limit2) {
  kernels_->residuals(lifted_, normalTask(task, pose, Vector2::Zero()), squared_.data());
  near_.count = 0;
  near_.pushBelow(lifted_, squared_.data(), limit2, kept_.data());
  near_.pad();
}

// Of rows without depth alone: a row with depth that disagrees is a wrong match more often than a wrong depth, and
// wrong matches of things that stand in a row agree with their planes and pull to one side (decision 108).
void PoseEstimator::keepNearPlanes(const RefineTask &task, const Rigid &pose, float limit2) {
  kernels_->plane_residuals(planes_, normalTask(task, pose, Vector2::Zero()), plane_squared_.data());
  near_planes_.count = 0;
  near_planes_.pushBelow(planes_, plane_squared_.data(), limit2, kept_.data());
  near_planes_.pad();
}

RefineTask PoseEstimator::task(const PoseQuery &query, double scale2) const {
  RefineTask task = {};
  task.kernels = kernels_;
  task.lifted = &near_;
  task.prior = query.prior;
  task.deadline = query.deadline;
  task.depth.mid_m = query.depth.mid_m;
  task.scale2 = scale2;
  return task;
}

void PoseEstimator::optimise(const PoseQuery &query, const Rigid &minimal, Search *search) {
  const RefineTask local = task(query, kLocalScale2);
  keepNear(local, minimal, kLocalLimit2);
  const Rigid pose = improvePose(local, minimal, kLocalSteps);
  const float gain = gainOf(pose, kMinimalThreshold2);
  if (gain > search->gain) {
    search->gain = gain;
    search->tight_gain = gainOf(pose, config_.inlier_threshold2);
    search->camera_from_map = pose;
  }
}

bool PoseEstimator::isNear(const PosePrior &prior, const Rigid &pose) {
  const Rigid off = pose * prior.camera_from_map.inverse();
  const double turn = rotationAngle(off.rotation) / prior.rotation_sigma_rad;
  const Vector3 centre = pose.inverse().translation_m - prior.camera_from_map.inverse().translation_m;
  const double shift = centre.norm() / prior.translation_sigma_m;
  return turn < kGateSigmas && shift < kGateSigmas;
}

// Returns how many of the samples were looked at, before there were `most` in all or enough in this round.
uint32_t PoseEstimator::scoreBatch(const PoseQuery &query, const PosePrior *gate, uint32_t most, Watch *watch,
                                   Search *search) {
  const float count = static_cast<float>(lifted_.count);
  for (uint32_t sample = 0; sample < kMinimalBatch; ++sample) {
    if (search->samples >= most || search->samples - search->begin >= search->needed) return sample;
    if (watch->passed(lifted_.count + kSampling)) return kMinimalBatch;
    ++search->samples;
    for (uint32_t solution = 0; solution < kMaxSolutions; ++solution) {
      if (poses_->valid[solution][sample] == 0.0f) continue;
      const PoseF pose = poses_->pose(solution, sample);
      if (gate && !isNear(*gate, rigidFrom(pose))) continue;
      ++search->hypotheses;
      const float share = search->minimal_gain / count * kShareOfBest;
      const ScoreLimits limits = {1 / static_cast<float>(kMinimalThreshold2), search->minimal_gain,
                                  share > kLeastShare ? share : kLeastShare, kSlack};
      const Score score = kernels_->score(lifted_, pose, limits);
      if (score.gain > search->minimal_gain && score.seen >= count) {
        search->minimal_gain = score.gain;
        optimise(query, rigidFrom(pose), search);
        search->needed = samplesFor(query, *search);
      } else {
        search->chance_gain += static_cast<double>(score.gain);
        search->chance_seen += static_cast<double>(score.seen);
      }
    }
  }
  return kMinimalBatch;
}

// Is the agreement more than chance explains?  Then it is the pose, and there is no other.  Chernoff's bound over
// all poses tried, at the inlier threshold, whose region is so much smaller than that of minimal samples.
bool PoseEstimator::isBeyondChance(const Search &search) const {
  const double wide_chance = search.chance_gain / (search.chance_seen + 1) + kLeastChance;
  const double chance = wide_chance * config_.inlier_threshold2 / kMinimalThreshold2;
  const double share = static_cast<double>(search.tight_gain) / lifted_.count;
  if (!(share > chance) || !(share < 1)) return share >= 1;
  const double information = share * logOf(share / chance) + (1 - share) * logOf((1 - share) / (1 - chance));
  return lifted_.count * information > kCertain + logOf(kMaxSolutions * search.samples);
}

// Samples needed to draw one without an outlier (Fischler and Bolles 1981); fewer once the pose is certain.
uint32_t PoseEstimator::samplesFor(const PoseQuery &query, const Search &search) const {
  const double share = 1.2 * static_cast<double>(search.gain) / lifted_.count;  // an inlier gains 0.83 on average
  double good = kUsefulSamples;
  for (uint32_t k = 0; k < sampleSize(query); ++k) good *= share < 1 ? share : 1;
  if (good < 1e-9) return config_.max_iterations;
  const double miss = isBeyondChance(search) ? kMissOnceCertain : config_.miss_probability;
  const double needed = logOf(miss) / logOf(1 - good);
  return needed < config_.max_iterations ? static_cast<uint32_t>(needed) + 1 : config_.max_iterations;
}

void PoseEstimator::sampleAndScore(const PoseQuery &query, const PosePrior *gate, uint32_t most, Search *search,
                                   Estimate *estimate) {
  const bool upright = sampleSize(query) == 2;
  UprightFrames frames = {};
  if (upright) {
    uprightFrom(query.prior->up_map, frames.upright_from_map);
    uprightFrom(query.prior->up_camera, frames.upright_from_camera);
  }
  sampler_.start(lifted_, quality_.first(lifted_.count), sampleSize(query), query.seed + (gate ? 1 : 0));
  search->begin = search->samples;
  search->needed = config_.max_iterations;
  Watch watch(query.deadline, kGrain);
  do {
    if (watch.passed(kSampling)) break;
    sampler_.draw(batch_);
    if (upright)
      kernels_->solve_upright(*batch_, frames, poses_);
    else
      kernels_->solve_p3p(*batch_, poses_);
  } while (scoreBatch(query, gate, most, &watch, search) == kMinimalBatch);
  if (watch.hasPassed()) estimate->cut_short = true;
}

bool PoseEstimator::isSupported(float gain) const {
  return gain > kVerifiedGain && gain > kVerifiedShare * static_cast<float>(lifted_.count);
}

// From a rough pose, with ever less tolerance.
Rigid PoseEstimator::approach(const PoseQuery &query, const Rigid &start) {
  Rigid pose = start;
  for (double scale2 : {400.0, 60.0, kLocalScale2}) {
    const RefineTask step = task(query, scale2);
    keepNear(step, pose, static_cast<float>(16 * scale2));
    pose = improvePose(step, pose, kLocalSteps);
  }
  return pose;
}

// A planar scene has a second pose; the search ends with either, since both are beyond chance.
void PoseEstimator::tryMirrored(const PoseQuery &query, Search *search) {
  Rigid mirrored;
  if (mirroredPose(query.correspondences, search->camera_from_map, kMinimalThreshold2, &mirrored))
    optimise(query, approach(query, mirrored), search);
}

// Is the pose where it was expected?
bool PoseEstimator::verifyPrior(const PoseQuery &query, Search *search) {
  const Rigid pose = approach(query, query.prior->camera_from_map);
  const float gain = gainOf(pose, kMinimalThreshold2);
  if (!isNear(*query.prior, pose) || !isSupported(gain)) return false;
  search->camera_from_map = pose;
  search->gain = search->minimal_gain = gain;
  return true;
}

Estimate PoseEstimator::search(const PoseQuery &query) {
  Estimate estimate;
  load(query);
  if (lifted_.count < kFewestRows) {
    estimate.ending = PoseEnding::kFewCorrespondences;
    return estimate;
  }
  Search state;
  const PosePrior *prior = query.prior && query.prior->has_pose ? query.prior : nullptr;
  if (!prior || !verifyPrior(query, &state)) {
    const uint32_t most = std::min(config_.max_iterations, query.most_samples);
    if (prior) sampleAndScore(query, prior, most / kSmallSearch, &state, &estimate);
    if (!isSupported(state.gain)) sampleAndScore(query, nullptr, most, &state, &estimate);
    if (state.gain > 0 && !estimate.cut_short) tryMirrored(query, &state);
  }
  estimate.iterations = state.samples;
  estimate.hypotheses = state.hypotheses;
  if (state.gain > 0) {
    finish(query, state.camera_from_map, &estimate);
  } else {
    estimate.ending = estimate.cut_short ? PoseEnding::kDeadline : PoseEnding::kNoConsensus;
  }
  return estimate;
}

Estimate PoseEstimator::refineMirrored(const PoseQuery &query, const Rigid &camera_from_map) {
  Estimate estimate;
  Rigid mirrored;
  if (!mirroredPose(query.correspondences, camera_from_map, config_.inlier_threshold2, &mirrored)) return estimate;
  load(query);
  finish(query, approach(query, mirrored), &estimate);
  return estimate;
}

Estimate PoseEstimator::refine(const PoseQuery &query, const Rigid &camera_from_map) {
  Estimate estimate;
  load(query);
  finish(query, camera_from_map, &estimate);
  return estimate;
}

// Is the row's error along its ray mostly depth's?
bool PoseEstimator::tellsOfDepth(const PoseRows &rows, uint32_t row, const Rigid &pose) const {
  const double stretch = static_cast<double>(rows.field[kStretch][row]);
  const double cosine = rows.view(row).dot(pose.rotation * rows.direction(row));
  return stretch > -1 && 1 + stretch * cosine * cosine > kMostlyDepth * (1 + stretch);
}

// Of the rows that agree with their epipolar plane: median error along the ray over what was expected.  Outliers of
// depth (edges, multipath) count, fakes rarely pass.
double PoseEstimator::noiseRatio(const NormalTask &kernel, const Rigid &pose) {
  kernels_->residuals(lifted_, kernel, squared_.data());
  kernels_->plane_residuals(lifted_, kernel, plane_squared_.data());
  uint32_t seen = 0;
  for (uint32_t i = 0; i < lifted_.count; ++i)
    if (plane_squared_[i] < kAgreeingPlane2 && tellsOfDepth(lifted_, i, pose))
      squared_[seen++] = squared_[i] - plane_squared_[i];
  if (seen < kFewestForNoise) return 0;
  std::nth_element(squared_.data(), squared_.data() + seen / 2, squared_.data() + seen);
  const double median = static_cast<double>(squared_[seen / 2]);
  return median > 0 && median < static_cast<double>(kFinalLimit2) ? sqrtOf(median / kMedianOfSquare) : 0;
}

// Mean squared residual of the inliers over its expectation, drawn to 1 by a few inliers that are as expected: the
// a-posteriori variance of unit weight (Mikhail and Ackermann, "Observations and Least Squares", 1976).
double PoseEstimator::unitVariance(const Estimate &estimate) const {
  const double squared = config_.inlier_threshold2 * (estimate.inliers - estimate.gain);
  return (squared / kResidualFreedom + kExpectedInliers) / (estimate.inliers + kExpectedInliers);
}

Estimate PoseEstimator::evaluate(const PoseQuery &query, const Rigid &camera_from_map) {
  Estimate estimate;
  load(query);
  polish(query, camera_from_map, 0, &estimate);
  return estimate;
}

void PoseEstimator::finish(const PoseQuery &query, const Rigid &start, Estimate *estimate) {
  const RefineTask local = task(query, kLocalScale2);
  keepNear(local, start, kLocalLimit2);
  polish(query, improvePose(local, start, kLocalSteps), kFinalIterations, estimate);
}

void PoseEstimator::polish(const PoseQuery &query, const Rigid &pose, int iterations, Estimate *estimate) {
  RefineTask last = task(query, kFinalScale2);
  last.planes = &near_planes_;
  last.depth.covariance = query.depth.covariance;
  keepNear(last, pose, kFinalLimit2);
  keepNearPlanes(last, pose, kFinalLimit2);
  const Refinement refined = refinePose(last, pose, iterations);
  estimate->camera_from_map = cleaned(refined.camera_from_map);
  Matrix8 information = refined.information;
  information.diagonal().array() += 1e-6;  // a direction that nothing pins down gets a large, finite variance
  const Matrix8 covariance = symmetricInverse(information);
  estimate->covariance = covariance.topLeftCorner<6, 6>();
  estimate->depth = query.depth;
  estimate->depth.mean += refined.bias;
  if (!query.depth.isKnown()) estimate->depth.covariance = covariance.bottomRightCorner<2, 2>();
  const NormalTask kernel = normalTask(last, estimate->camera_from_map, refined.bias);
  kernels_->residuals(near_, kernel, squared_.data());
  const float threshold2 = static_cast<float>(config_.inlier_threshold2);
  for (uint32_t i = 0; i < near_.count; ++i) {
    if (!(squared_[i] < threshold2)) continue;
    ++estimate->inliers;
    estimate->gain += 1 - static_cast<double>(squared_[i]) / config_.inlier_threshold2;
  }
  estimate->lifted = lifted_.count;
  estimate->unit_variance = unitVariance(*estimate);
  estimate->noise_ratio = noiseRatio(kernel, estimate->camera_from_map);
  estimate->ending = PoseEnding::kFound;
}

bool PoseEstimator::isInlier(const Correspondence &correspondence, const Estimate &estimate) const {
  if (!correspondence.lifted.hasDepth()) return false;
  const Correspondence seen = {corrected(correspondence.lifted, estimate.depth), correspondence.direction};
  const Residual r = residualOf(seen, estimate.camera_from_map);
  return r.in_front && r.squared < config_.inlier_threshold2;
}

}  // namespace sphc
