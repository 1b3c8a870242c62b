#include "runtime/stages/pose/confidence.h"

#include <algorithm>

#include "runtime/base/elementary.h"

namespace sphc {
namespace {

// Errors are so many times those of independent matches, kMany with many inliers and more with few.  Fitted on half
// of the recordings, with which the other half agrees within a tenth (docs/confidence.md).
constexpr double kMany = 0.9, kFew = 60, kFewerThan = 30;
// The odds that errors are within bounds fall with this power of the sigma; and what they are where both are equal.
constexpr double kPower = 3.5, kLogOddsAtBound = 0.1;
constexpr double kLeastRatio = 0.02, kMostRatio = 10;  // between these it was measured

double rootTrace(const Matrix6 &covariance, int first) {
  const double trace = covariance.block<3, 3>(first, first).trace();
  return trace >= 0 ? sqrtOf(trace) : __builtin_nan("");
}

double statedOverEstimated(const Estimate &estimate) {
  const double scale = kMany + kFew / (estimate.inliers + kFewerThan);
  return scale * scale * estimate.unit_variance;
}

}  // namespace

Matrix6 statedCovariance(const Estimate &estimate) { return statedOverEstimated(estimate) * estimate.covariance; }

void widen(double turn_sigma_rad, double shift_sigma_m, Estimate *estimate) {
  if (turn_sigma_rad == 0 && shift_sigma_m == 0) return;
  const double stated = statedOverEstimated(*estimate);
  estimate->covariance.topLeftCorner<3, 3>().diagonal().array() += turn_sigma_rad * turn_sigma_rad / stated;
  estimate->covariance.bottomRightCorner<3, 3>().diagonal().array() += shift_sigma_m * shift_sigma_m / stated;
}

double axisSigma(const Matrix6 &covariance, int first) {
  return sqrtOf(covariance.block<3, 3>(first, first).trace() / 3);
}

double confidenceOf(const Matrix6 &covariance, const ErrorBounds &bounds) {
  if (!(bounds.translation_m > 0) || !(bounds.rotation_rad > 0)) return 0;
  const double turn = rootTrace(covariance, 0) / bounds.rotation_rad;
  // T = exp(xi) T_estimate moves the camera's place in the map by the translation part of xi alone.
  const double shift = rootTrace(covariance, 3) / bounds.translation_m;
  if (turn != turn || shift != shift) return 0;
  const double ratio = std::min(std::max(std::max(turn, shift), kLeastRatio), kMostRatio);
  return 1 / (1 + expOf(kPower * logOf(ratio) - kLogOddsAtBound));
}

}  // namespace sphc
