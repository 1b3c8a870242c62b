// Is a pose to be believed?
#pragma once
#include "runtime/base/span.h"
#include "runtime/localizer/result.h"
#include "runtime/types/correspondence.h"

namespace sphc {

// Where a correspondence agrees with a pose, and where its map point was looked for.
struct InlierRegion {
  double noise_scale = 1;  // of depth, over the stated one
  double threshold2 = 0;   // squared whitened residual
  double solid_angle_sr = 4 * kPi;
};

// Bound on the natural logarithm of the probability that as many as `inliers` of these correspondences would agree
// with the pose by chance, their directions being spread evenly over the solid angle (4 pi: the sphere) around the
// predicted ones; kMinimalSample of them agree because the pose was made from them.  An a-contrario test, as in
// Moisan and Stival, "A probabilistic criterion to detect rigid point matches" (IJCV 2004).
constexpr uint32_t kMinimalSample = 3;
double logChanceOfAgreement(Span<const Correspondence> correspondences, const Rigid &camera_from_map,
                            uint32_t inliers, const InlierRegion &region);

// Where the matches behind a pose were looked for.
enum class MatchSource : uint8_t {
  kGlobal,   // everywhere, then near where that pose predicts: two pieces of evidence
  kExpected  // both times near where a pose was expected: much the same matches, so only the weaker counts
};

// What speaks for a pose.
struct Evidence {
  uint32_t inliers = 0;          // after guided re-matching
  double log_chance_first = 0;   // of the first matches that agree, times the poses tried
  double log_chance_second = 0;  // of the agreement after guided re-matching, near the predictions
  MatchSource source = MatchSource::kGlobal;
  double centre_sigma_ratio = 1;  // without the high-leverage observations, over that with them

  // Of both.
  double logChance() const;
};

// The errors of a pose over its stated ones, at most: matches that are wrong among few are not in the covariance.
double doubtOf(uint32_t inliers);
Outcome judgePose(const Evidence &evidence, const Estimate &estimate, uint32_t min_inliers);

}  // namespace sphc
