#include "runtime/localizer/judgement.h"

namespace sphc {
namespace {

// Around a wrong pose a match lands inside the inlier region about as often as that covers the search cap.
constexpr double kChance = 0.12;
constexpr double kMostLogChance = -20;  // accept when chance would do it once in e^20 frames
constexpr double kMostRotationSigma = 0.02;    // rad
constexpr double kMostTranslationSigma = 0.04; // m

// Chernoff's bound on log P(at least `successes` of `trials` by chance).
double logChance(uint32_t successes, uint32_t trials, double chance) {
  const double share = static_cast<double>(successes) / trials;
  if (share <= chance) return 0;
  const double rest = share < 1 ? (1 - share) * logOf((1 - share) / (1 - chance)) : 0;
  return -static_cast<double>(trials) * (share * logOf(share / chance) + rest);
}

}  // namespace

sphc_outcome judgePose(const Estimate &estimate, uint32_t matches, uint32_t min_inliers) {
  if (estimate.inliers < min_inliers || logChance(estimate.inliers, matches, kChance) > kMostLogChance)
    return SPHC_OUTCOME_NO_CONSENSUS;
  const double rotation2 = estimate.covariance.topLeftCorner<3, 3>().trace();
  // Of the camera's place in the map: rotation and translation errors compensate, so the raw block would mislead.
  const Matrix3 skew = crossMatrix(estimate.camera_from_map.translation_m);
  Eigen::Matrix<double, 3, 6> to_centre;
  to_centre << skew, Matrix3::Identity();
  const double centre2 = (to_centre * estimate.covariance * to_centre.transpose()).trace();
  if (!(rotation2 < kMostRotationSigma * kMostRotationSigma) ||
      !(centre2 < kMostTranslationSigma * kMostTranslationSigma))
    return SPHC_OUTCOME_UNCERTAIN;
  return SPHC_OUTCOME_LOCALIZED;
}

}  // namespace sphc
