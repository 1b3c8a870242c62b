#include "runtime/localizer/handedness.h"

#include <algorithm>

#include "runtime/base/fixed_vector.h"
#include "runtime/localizer/tuning.h"

namespace sphc {

using namespace tuning;

Spread spreadOf(Span<const Correspondence> correspondences, const Estimate &estimate,
                const PoseEstimator &estimator) {
  FixedVector<Eigen::Vector3f, kAskedForSpread> directions;
  for (const Correspondence &c : correspondences)
    if (!directions.full() && c.lifted.hasDepth() && estimator.isInlier(c, estimate))
      directions.push(c.direction.cast<float>());
  uint32_t most = 0;
  for (const Eigen::Vector3f &middle : directions) {
    const auto isHere = [&](const Eigen::Vector3f &d) { return d.dot(middle) > kSpotCosine; };
    most = std::max(most, static_cast<uint32_t>(std::count_if(directions.begin(), directions.end(), isHere)));
  }
  const auto inliers = static_cast<uint32_t>(directions.size());
  return {inliers, inliers - most};
}

bool mayBeMirrored(const Spread &spread) {
  const double most = spread.elsewhere < kFewElsewhere ? kMostElsewhereOfFew : kMostElsewhereOfMirrored;
  return spread.elsewhere < most * spread.inliers;
}

Handedness handednessOf(const Spread &frame, const Spread &mirrored) {
  if (mirrored.elsewhere >= kFewestElsewhere && mirrored.elsewhere >= kTimesElsewhere * frame.elsewhere)
    return Handedness::kChanged;
  const bool is_kept = frame.elsewhere > mirrored.elsewhere ||
                       (frame.elsewhere == mirrored.elsewhere && frame.inliers >= mirrored.inliers);
  return is_kept || mirrored.inliers == 0 ? Handedness::kKept : Handedness::kUnclear;
}

}  // namespace sphc
