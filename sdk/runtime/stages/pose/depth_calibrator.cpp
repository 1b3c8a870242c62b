#include "runtime/stages/pose/depth_calibrator.h"

#include <Eigen/LU>

#include "runtime/stages/pose/symmetric.h"

namespace sphc {
namespace {

// Frames of one scene share their errors (glossy floors, edges), so each counts as part of an independent one.
constexpr double kTrust = 0.3;
constexpr double kMostShift = 0.9;    // sigmas a frame
constexpr double kNoiseStep = 0.2;    // of the way to a frame's noise, in the logarithm
constexpr double kSlopeDrift = 1e-4;  // a frame, 1 sigma: sensors warm up

}  // namespace

void DepthCalibrator::init(const DepthCalibration &prior) { prior_ = current_ = prior; }

void DepthCalibrator::learn(const Estimate &estimate) {
  if (current_.isKnown()) return;
  if (estimate.noise_ratio > 0) {
    const double scale = current_.noise_scale * expOf(kNoiseStep * logOf(estimate.noise_ratio));
    current_.noise_scale = scale < kLeastNoiseScale  ? kLeastNoiseScale
                           : scale > kMostNoiseScale ? kMostNoiseScale
                                                     : scale;
  }
  const Matrix2 before = current_.covariance.inverse(), after = estimate.depth.covariance.inverse();
  // A frame that says quite another thing is trusted less, and moves the belief by a sigma at most (Huber).
  const Vector2 surprise = estimate.depth.mean - current_.mean;
  const double surprise2 = surprise.dot(before * surprise);
  const double trust = surprise2 > 1 ? kTrust / surprise2 : kTrust;
  const Matrix2 information = before + trust * (after - before);
  const Vector2 weighted = before * current_.mean + trust * (after * estimate.depth.mean - before * current_.mean);
  Matrix2 covariance = information.inverse();
  covariance(1, 1) += kSlopeDrift * kSlopeDrift;
  Vector2 shift = solveSymmetric(information, weighted) - current_.mean;
  const double shift2 = shift.dot(before * shift);
  if (shift2 > kMostShift * kMostShift) shift *= kMostShift / sqrtOf(shift2);
  const Vector2 mean = current_.mean + shift;
  if (!isFinite(mean.sum()) || !(covariance(0, 0) > 0) || !(covariance(1, 1) > 0)) return;
  current_.mean = mean;
  // Information never makes it less certain than it was to begin with.
  if (covariance(0, 0) <= prior_.covariance(0, 0) && covariance(1, 1) <= prior_.covariance(1, 1))
    current_.covariance = covariance;
}

}  // namespace sphc
