// Is a pose to be believed?
#pragma once
#include "runtime/base/span.h"
#include "runtime/types/correspondence.h"
#include "runtime/types/estimate.h"
#include "spherecloud/spherecloud.h"

namespace sphc {

// Bound on the natural logarithm of the probability that as many as `inliers` of these correspondences would agree
// with the pose by chance, their directions being spread evenly over `solid_angle_sr` (4 pi: the sphere) around the
// predicted ones.  `free`: of the inliers, how many agree because the pose was made from them.
// `noise_scale`: of depth, over the stated one.  An a-contrario test, as in Moisan and Stival, "A probabilistic
// criterion to detect rigid point matches" (IJCV 2004).
double logChanceOfAgreement(Span<const Correspondence> correspondences, const Rigid &camera_from_map,
                            uint32_t inliers, uint32_t free, double noise_scale, double inlier_threshold2,
                            double solid_angle_sr);

// The looks at a map that led to a pose.
enum class Looks : uint8_t {
  kGlobal,  // everywhere, then near where that pose predicts: two pieces of evidence
  kGuided   // both near where a pose was expected: of much the same matches, so only the weaker counts
};

// What speaks for a pose.
struct Evidence {
  uint32_t inliers;          // in the second look
  double log_chance_first;   // of the global matches that agree, times the poses tried
  double log_chance_second;  // of the agreement in the second look, near the predictions
  Looks looks = Looks::kGlobal;
  double vaguer = 1;  // times: the camera centre, without the matches that the pose leans on most
};

// The errors of a pose over its stated ones, at most: matches that are wrong among few are not in the covariance.
double doubtOf(uint32_t inliers);
sphc_outcome judgePose(const Evidence &evidence, const Estimate &estimate, uint32_t min_inliers);

}  // namespace sphc
