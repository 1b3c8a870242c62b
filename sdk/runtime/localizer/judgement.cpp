#include "runtime/localizer/judgement.h"

#include <algorithm>

#include "runtime/localizer/tuning.h"

namespace sphc {
namespace {

using namespace tuning;

// Chernoff's bound on log P(at least `successes` of `trials`); for unequal chances too, given their mean.
double logTail(double successes, double trials, double mean_chance) {
  if (!(trials > 0)) return 0;
  const double chance = mean_chance > 1e-9 ? mean_chance : 1e-9;
  const double share = successes / trials;
  if (share <= chance) return 0;
  const double rest = share < 1 ? (1 - share) * logOf((1 - share) / (1 - chance)) : 0;
  return -trials * (share * logOf(share / chance) + rest);
}

// Share of the solid angle that the inlier region covers, seen from the sphere centre.
double inlierShare(const Correspondence &c, const Rigid &camera_from_map, const InlierRegion &region) {
  const Vector3 offset = c.lifted.point_m - camera_from_map.translation_m;
  const double distance2 = offset.squaredNorm();
  const double along_view = offset.dot(c.lifted.view());
  const double cosine2 = along_view * along_view / distance2;  // between the map ray and the viewing ray
  const double s = c.lifted.sideways_m, a = region.noise_scale * c.lifted.along_m;
  const double area = kPi * region.threshold2 * s * sqrtOf(s * s * cosine2 + a * a * (1 - cosine2));
  const double share = area / (distance2 * region.solid_angle_sr);
  return share < 1 ? share : 1;
}

}  // namespace

double logChanceOfAgreement(Span<const Correspondence> correspondences, const Rigid &camera_from_map,
                            uint32_t inliers, const InlierRegion &region) {
  if (inliers <= kMinimalSample) return 0;
  double sum = 0, count = 0;
  for (const Correspondence &c : correspondences) {
    if (!c.lifted.hasDepth()) continue;
    sum += inlierShare(c, camera_from_map, region);
    ++count;
  }
  return logTail(inliers - kMinimalSample, count - kMinimalSample, sum / count);
}

double doubtOf(uint32_t inliers) { return 1 + kInliersOfDoubt / inliers; }

double Evidence::logChance() const {
  return source == MatchSource::kExpected ? std::max(log_chance_first, log_chance_second)
                                          : log_chance_first + log_chance_second;
}

Outcome judgePose(const Evidence &evidence, const Estimate &estimate, uint32_t min_inliers) {
  const bool expected = evidence.source == MatchSource::kExpected;
  if (evidence.inliers < min_inliers || evidence.logChance() > (expected ? kMostLogChanceExpected : kMostLogChance))
    return Outcome::kNoConsensus;
  const double doubt = doubtOf(evidence.inliers), doubt2 = doubt * doubt;
  const double rotation2 = estimate.covariance.topLeftCorner<3, 3>().trace();
  // T = exp(xi) T_estimate moves the camera's place in the map by the translation part of xi alone.
  const double centre2 = estimate.covariance.bottomRightCorner<3, 3>().trace();
  if (estimate.covariance.diagonal().minCoeff() < 0)
    return Outcome::kUncertain;  // numbers beyond what rounding bears
  if (!(doubt2 * rotation2 < kMostRotationSigmaRad * kMostRotationSigmaRad) ||
      !(doubt2 * centre2 < kMostTranslationSigmaM * kMostTranslationSigmaM))
    return Outcome::kUncertain;
  const double without2 = doubt2 * centre2 * evidence.centre_sigma_ratio * evidence.centre_sigma_ratio;
  if (!(without2 < kMostSigmaWithoutLeverageM * kMostSigmaWithoutLeverageM)) return Outcome::kUncertain;
  return Outcome::kLocalized;
}

}  // namespace sphc
