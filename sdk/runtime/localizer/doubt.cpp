#include "runtime/localizer/doubt.h"

#include <algorithm>

#include "runtime/localizer/tuning.h"
#include "runtime/stages/pose/confidence.h"
#include "runtime/stages/pose/focal_scale.h"

namespace sphc {

using namespace tuning;

namespace {

// How far the map points of a pose's inliers lie from the map's centroid, by depth.
class PointsOfPose {
 public:
  PointsOfPose(const Hypothesis &found, const PoseEstimator &estimator)
      : found_(found),
        estimator_(estimator),
        map_from_camera_(found.estimate.camera_from_map.inverse()),
        pose_variance_m2_(2.0 / 3 * statedCovariance(found.estimate).bottomRightCorner<3, 3>().trace()) {}

  const Vector3 &centre_m() const { return map_from_camera_.translation_m; }
  using Use = void (PointDistances::*)(const PointDistance &);
  void each(Use use, PointDistances *distances) const {
    const Span<const Correspondence> all = found_.matched.ofThisFrame();
    for (uint32_t i = 0; i < all.size(); ++i)
      if (all[i].lifted.hasDepth() && estimator_.isInlier(all[i], found_.estimate))
        (distances->*use)(distanceOf(all[i], found_.matched.matches()[i].point_index));
  }

 private:
  PointDistance distanceOf(const Correspondence &c, uint32_t point_index) const {
    const LiftedPoint lifted = corrected(c.lifted, found_.estimate.depth);
    const double distance_m = c.direction.dot(map_from_camera_ * lifted.point_m);
    const double cosine = lifted.view().dot(found_.estimate.camera_from_map.rotation * c.direction);
    const double across2 = lifted.sideways_m * lifted.sideways_m, along2 = lifted.along_m * lifted.along_m;
    const double own2 =
        kDistanceFloorM * kDistanceFloorM + kDistanceShare * kDistanceShare * distance_m * distance_m;
    return {point_index, distance_m, across2 + (along2 - across2) * cosine * cosine + pose_variance_m2_ + own2};
  }

  const Hypothesis &found_;
  const PoseEstimator &estimator_;
  Rigid map_from_camera_;
  double pose_variance_m2_;  // twice that of an axis: neighbours share it
};

}  // namespace

Vertical compareVertical(const Known &known, const Hypothesis &found, PoseQuery query, uint32_t min_inliers,
                         PoseEstimator *estimator) {
  if (!found.isLocalized()) return Vertical::kUnknown;
  if (!known.prior.has_up || known.map != found.map) return Vertical::kAgrees;
  query.correspondences = found.matched.all();
  const Estimate alone = estimator->refine(query, found.estimate.camera_from_map);
  if (alone.inliers < min_inliers) return Vertical::kUnknown;
  const double turn_sigma = axisSigma(alone.covariance, 0) * doubtOf(alone.inliers);
  const bool is_off = angleBetween(alone.camera_from_map.rotation * known.prior.up_map, known.prior.up_camera) >
                      std::max(kLeastVerticalRad, kVerticalSigmas * hypotOf(turn_sigma, known.prior.up_sigma_rad));
  return is_off ? Vertical::kDisagrees : Vertical::kAgrees;
}

bool isBeyondPrior(const DepthCalibration &learnt, const DepthCalibration &prior) {
  if (prior.isKnown()) return false;
  const Vector2 off = learnt.mean - prior.mean;
  return off[0] * off[0] > kBiasSigmas * kBiasSigmas * prior.covariance(0, 0) ||
         off[1] * off[1] > kBiasSigmas * kBiasSigmas * prior.covariance(1, 1);
}

FocalLength compareFocalLength(const Hypothesis &found, const DepthCalibration &depth, const Deadline &deadline) {
  const auto isOff = [&](FocalDerivatives derivatives) {
    const FocalScale scale = focalScaleOf(found.matched.ofThisFrame(), found.estimate, depth, derivatives,
                                          kDoubtfulFocalSigmas, deadline);
    return scale.isBeyond(kFocalSigmas) && absOf(scale.off) > kLeastFocalOff;
  };
  if (isOff(FocalDerivatives::kAtFoot)) return FocalLength::kDisagrees;
  return isOff(FocalDerivatives::kAtPoint) ? FocalLength::kDoubtful : FocalLength::kAgrees;
}

double doubted(double confidence, const Hypothesis &found, Faults faults, bool edges_are_doubtful) {
  if (faults & (kDepthScale | kDepthBias)) return std::min(confidence, kMostConfidenceOfFaults);
  const bool edges_count = edges_are_doubtful && found.estimate.inliers < kInliersBeyondDoubtfulEdges;
  if (edges_count || found.has_doubtful_focal || (faults & kFocalDisagrees))
    return std::min(confidence, kMostConfidenceOfDoubt);
  return found.has_near_rival ? std::min(confidence, kMostConfidenceOfNearRival) : confidence;
}

bool TravelCheck::isScaled(const Known &known, const Tracker &tracker, const Hypothesis &found) {
  Rigid step;
  double unused_rad, step_sigma_m;
  if (!tracker.step(&step, &unused_rad, &step_sigma_m)) reset();
  way_variance_m2_ += step_sigma_m * step_sigma_m;
  if (!known.has_odometry || !found.isLocalized()) return false;
  if (found.map != map_) reset();
  map_ = found.map;
  travel_.add(found.estimate.camera_from_map.inverse().translation_m,
              known.odometry.odometry_from_camera.translation_m, axisSigma(found.estimate.covariance, 3),
              way_variance_m2_);
  way_variance_m2_ = 0;
  was_scaled_ = travel_.isScaled();
  return was_scaled_;
}

bool DistanceCheck::disagrees(int64_t time_ns, const Hypothesis &found, const PoseEstimator &estimator) {
  if (found.map != map_ || time_ns <= last_ns_) reset();
  map_ = found.map;
  last_ns_ = time_ns;
  const PointsOfPose points(found, estimator);
  distances_.begin(points.centre_m(), time_ns);
  points.each(&PointDistances::compare, &distances_);
  const bool before = disagrees_;
  disagrees_ = distances_.disagree();
  if (disagrees_ && !before) since_ns_ = time_ns;
  if (disagrees_ && elapsedNs(since_ns_, time_ns) < Tracker::kForgetNs) return true;
  if (disagrees_) reset();
  return false;
}

void DistanceCheck::keep(const Hypothesis &found, const PoseEstimator &estimator) {
  const PointsOfPose points(found, estimator);
  points.each(&PointDistances::keep, &distances_);
}

}  // namespace sphc
