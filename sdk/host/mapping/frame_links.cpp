#include "host/mapping/frame_links.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/frames/heap_arena.h"
#include "runtime/localizer/judgement.h"
#include "runtime/stages/pose/confidence.h"

namespace sphc::host {
namespace {

constexpr uint32_t kMostSamples = 3000;
constexpr double kMostLogChance = -20;  // that so many agree by chance; the localizer asks for -12
// The two directions are one pose where they differ by no more than their sigmas and what a depth sensor that reads
// long or short makes of them.
constexpr double kSigmas = 5, kOffM = 0.02, kOffRad = 0.01;
// Expected poses: 1 sigma.
constexpr double kExpectedRad = 0.05, kExpectedM = 0.10;
constexpr double kMostEpipolar = 3;  // sigmas, of matches without depth

// Both keypoints are off: the one that is lifted, and the bearing that it is compared with.
Correspondence correspondenceOf(const SeenPoint &point, const SeenPoint &direction) {
  const double angle = std::hypot(point.sigma, direction.sigma);
  Correspondence c;
  c.direction = direction.bearing;
  if (point.hasDepth()) {
    const double lengthening = std::sqrt(point.ray.squaredNorm() + 1);
    c.lifted = {point.point_m(), angle * point.depth_m, point.depth_sigma_m * lengthening};
  } else {
    c.lifted = {point.bearing, angle, std::numeric_limits<double>::infinity()};
  }
  return c;
}

double norm2(const Matrix6 &covariance, int block) { return covariance.diagonal().segment<3>(block).sum(); }

bool agree(const Estimate &there, const Estimate &back) {
  const Rigid round = there.camera_from_map * back.camera_from_map;
  const double turn_sigma = std::sqrt(norm2(there.covariance, 0) + norm2(back.covariance, 0)),
               shift_sigma = std::sqrt(norm2(there.covariance, 3) + norm2(back.covariance, 3));
  return rotationAngle(round.rotation) < kSigmas * turn_sigma + kOffRad &&
         round.translation_m.norm() < kSigmas * shift_sigma + kOffM;
}

// Distance of a bearing from the plane of the baseline and the other bearing, in sigmas.
bool isEpipolar(const SeenPoint &a, const SeenPoint &b, const Rigid &b_from_a) {
  const Vector3 normal = b_from_a.translation_m.cross(b_from_a.rotation * a.bearing);
  const double length = normal.norm(), sigma = std::hypot(a.sigma, b.sigma);
  return length > 0 && std::abs(normal.dot(b.bearing)) < kMostEpipolar * sigma * length;
}

}  // namespace

FrameLinker::FrameLinker(uint32_t max_keypoints) {
  EstimatorConfig config;
  config.capacity = max_keypoints;
  config.max_iterations = kMostSamples;
  Arena size;
  PoseEstimator::layout(config, size, nullptr);
  Arena arena = heapFor(size, &memory_);
  PoseEstimator::layout(config, arena, &estimator_);
}

void FrameLinker::localize(const Rigid *expected, Side *side) {
  PosePrior prior;
  if (expected) {
    prior.has_pose = true;
    prior.camera_from_map = *expected;
    prior.rotation_sigma_rad = kExpectedRad;
    prior.translation_sigma_m = kExpectedM;
  }
  PoseQuery query;
  query.correspondences = {side->correspondences.data(), side->correspondences.size()};
  query.prior = expected ? &prior : nullptr;
  query.seed = 1;
  side->estimate = estimator_.search(query);
}

bool FrameLinker::isSupported(const Side &side, const LinkDemands &demands) const {
  const Estimate &estimate = side.estimate;
  if (estimate.ending != PoseEnding::kFound || estimate.inliers < demands.min_inliers) return false;
  if (estimate.inliers < demands.min_share * estimate.lifted) return false;
  InlierRegion region;
  region.threshold2 = estimator_.inlierThreshold2();
  const Span<const Correspondence> all = {side.correspondences.data(), side.correspondences.size()};
  return logChanceOfAgreement(all, estimate.camera_from_map, estimate.inliers, region) < kMostLogChance;
}

std::optional<FrameLink> FrameLinker::link(const std::vector<WalkFrame> &frames, const FramePair &pair,
                                           const LinkDemands &demands, const Rigid *expected) {
  const WalkFrame &a = frames[pair.a], &b = frames[pair.b];
  const std::vector<PointMatch> matches = expected ? matchNear(a, b, *expected) : matchAll(a, b);
  if (matches.size() < demands.min_inliers) return std::nullopt;
  Side in_b, in_a;
  for (const PointMatch &m : matches) {
    in_b.correspondences.push_back(correspondenceOf(b.points[m.b], a.points[m.a]));
    in_a.correspondences.push_back(correspondenceOf(a.points[m.a], b.points[m.b]));
  }
  localize(expected, &in_b);
  if (!isSupported(in_b, demands)) return std::nullopt;
  const Rigid back = in_b.estimate.camera_from_map.inverse();
  localize(expected ? &back : nullptr, &in_a);
  if (!isSupported(in_a, demands) || !agree(in_b.estimate, in_a.estimate)) return std::nullopt;
  FrameLink link;
  link.frames = pair;
  link.b_from_a = in_b.estimate.camera_from_map;
  link.covariance = in_b.estimate.covariance;
  link.inliers = std::min(in_b.estimate.inliers, in_a.estimate.inliers);
  for (size_t i = 0; i < matches.size(); ++i) {
    const SeenPoint &of_a = a.points[matches[i].a], &of_b = b.points[matches[i].b];
    const bool agrees_in_b = !of_b.hasDepth() || estimator_.isInlier(in_b.correspondences[i], in_b.estimate),
               agrees_in_a = !of_a.hasDepth() || estimator_.isInlier(in_a.correspondences[i], in_a.estimate);
    if (agrees_in_b && agrees_in_a && (of_a.hasDepth() || of_b.hasDepth() || isEpipolar(of_a, of_b, link.b_from_a)))
      link.matches.push_back(matches[i]);
  }
  return link;
}

}  // namespace sphc::host
