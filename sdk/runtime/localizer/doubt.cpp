#include "runtime/localizer/doubt.h"

#include <algorithm>

#include "runtime/localizer/tuning.h"

namespace sphc {

using namespace tuning;

namespace {

double angleBetween(const Vector3 &a, const Vector3 &b) { return atan2Of(a.cross(b).norm(), a.dot(b)); }

// Of one axis, from a pose's covariance.
double meanSigma(const Estimate &estimate, int first) {
  return sqrtOf(estimate.covariance.block<3, 3>(first, first).trace() / 3);
}

}  // namespace

bool verticalDisagrees(const Known &known, const Hypothesis &found, PoseQuery query, uint32_t min_inliers,
                       PoseEstimator *estimator) {
  if (!found.isLocalized() || !known.prior.has_up || known.map != found.map) return false;
  query.correspondences = found.matched.all();
  const Estimate alone = estimator->refine(query, found.estimate.camera_from_map);
  if (alone.inliers < min_inliers) return false;
  const double turn_sigma = meanSigma(alone, 0) * doubtOf(alone.inliers);
  return angleBetween(alone.camera_from_map.rotation * known.prior.up_map, known.prior.up_camera) >
         std::max(kLeastVerticalRad, kVerticalSigmas * hypotOf(turn_sigma, known.prior.up_sigma_rad));
}

bool isBeyondPrior(const DepthCalibration &learnt, const DepthCalibration &prior) {
  if (prior.isKnown()) return false;
  const Vector2 off = learnt.mean - prior.mean;
  return off[0] * off[0] > kBiasSigmas * kBiasSigmas * prior.covariance(0, 0) ||
         off[1] * off[1] > kBiasSigmas * kBiasSigmas * prior.covariance(1, 1);
}

double doubted(double confidence, uint32_t inliers, Faults faults, bool edges_are_doubtful) {
  if (faults & (kDepthScale | kDepthBias)) return std::min(confidence, kMostConfidenceOfFaults);
  const bool doubtful = edges_are_doubtful && inliers < kInliersBeyondDoubtfulEdges;
  return doubtful ? std::min(confidence, kMostConfidenceOfDoubtfulEdges) : confidence;
}

bool TravelCheck::isScaled(const Known &known, const Tracker &tracker, const Hypothesis &found) {
  Rigid step;
  double unused_rad, step_sigma_m;
  if (!tracker.step(&step, &unused_rad, &step_sigma_m)) travel_.reset();
  if (!known.has_odometry || !found.isLocalized()) return false;
  if (found.map != map_) travel_.reset();
  map_ = found.map;
  travel_.add(found.estimate.camera_from_map.inverse().translation_m,
              known.odometry.odometry_from_camera.translation_m, meanSigma(found.estimate, 3));
  return travel_.isScaled(step_sigma_m);
}

}  // namespace sphc
