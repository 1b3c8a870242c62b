// How large the errors of a pose are, and the probability that they stay within bounds.  docs/confidence.md says
// what it was fitted on, and how well it holds elsewhere.
#pragma once
#include "runtime/types/estimate.h"

namespace sphc {

// The covariance of a pose as its errors really are.  That of the estimate takes the matches for independent and
// the noise for what was stated; this one knows how far the inliers scatter (the a-posteriori variance of unit
// weight), and that few inliers hide outliers and errors of the map.
Matrix6 statedCovariance(const Estimate &estimate);

// The stated covariance grows by this much, 1 sigma an axis, for reasons that no match shows.
void widen(double turn_sigma_rad, double shift_sigma_m, Estimate *estimate);

// 1 sigma an axis: of turns where `first` is 0, in rad, and of shifts where it is 3, in m.
double axisSigma(const Matrix6 &covariance, int first);

// Within which a pose counts as right.
struct ErrorBounds {
  double translation_m = 0.05, rotation_rad = 5 * kPi / 180;
};

// In [0, 1] whatever the inputs; 0 when one is not a number or a bound is not above 0.  Never falls when the
// covariance shrinks or a bound grows.  `covariance` as stated above.
double confidenceOf(const Matrix6 &covariance, const ErrorBounds &bounds = {});

}  // namespace sphc
