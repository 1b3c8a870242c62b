#include "runtime/stages/pose/confidence.h"

#include "runtime/base/elementary.h"

namespace sphc {
namespace {

constexpr double kTolerableM = 0.05, kTolerableRad = 5 * kPi / 180;

// Constants printed by `spherecloud bench confidence --fit`; docs/confidence.md.
constexpr ConfidenceModel kModel = {0, {1, 1, 1, 1, 1, 1}};

double clamped(double value, double low, double high) { return value < low ? low : value > high ? high : value; }

// Of a value that may be zero or without bound.
double logWithin(double value, double low, double high) { return logOf(clamped(value, low, high)); }

double sigmaOf(double variance) {
  return variance >= 0 ? sqrtOf(variance) : __builtin_nan("");  // NaN stays NaN
}

}  // namespace

const char *const kConfidenceFeatureNames[kConfidenceFeatures] = {"odds",   "gain share",     "inliers",
                                                                  "spread", "rotation sigma", "centre sigma"};

const ConfidenceModel &confidenceModel() { return kModel; }

ConfidenceInputs confidenceInputs(const Estimate &searched, const Estimate &refined) {
  // Rotation and translation errors compensate; of interest is the camera's place in the map.
  Eigen::Matrix<double, 3, 6> to_centre;
  to_centre << crossMatrix(refined.camera_from_map.translation_m), Matrix3::Identity();
  const double noise = refined.noise_ratio > 1 ? refined.noise_ratio : 1;
  ConfidenceInputs inputs;
  inputs.log_odds = searched.log_odds;
  inputs.gain_share = searched.lifted > 0 ? searched.gain / searched.lifted : 0;
  inputs.inliers = refined.inliers;
  inputs.spread_rad = refined.spread_rad;
  inputs.rotation_sigma_rad = noise * sigmaOf(refined.covariance.topLeftCorner<3, 3>().trace());
  inputs.centre_sigma_m = noise * sigmaOf((to_centre * refined.covariance * to_centre.transpose()).trace());
  return inputs;
}

bool confidenceFeatures(const ConfidenceInputs &inputs, ConfidenceFeatures *features) {
  for (double input : {inputs.log_odds, inputs.gain_share, inputs.inliers, inputs.spread_rad,
                       inputs.rotation_sigma_rad, inputs.centre_sigma_m})
    if (input != input) return false;
  *features = {{logWithin(inputs.log_odds, 1, 100), logWithin(inputs.gain_share, 0.01, 1),
                logWithin(inputs.inliers, 1, 200), logWithin(inputs.spread_rad, 0.01, 1),
                -logWithin(inputs.rotation_sigma_rad / kTolerableRad, 0.01, 10),
                -logWithin(inputs.centre_sigma_m / kTolerableM, 0.02, 10)}};
  return true;
}

double confidenceFrom(const ConfidenceModel &model, const ConfidenceFeatures &features) {
  double logit = model.intercept;
  for (int k = 0; k < kConfidenceFeatures; ++k) logit += model.weight[k] * features.value[k];
  return 1 / (1 + expOf(-clamped(logit, -30, 30)));
}

double confidenceOf(const ConfidenceInputs &inputs) {
  ConfidenceFeatures features;
  return confidenceFeatures(inputs, &features) ? confidenceFrom(kModel, features) : 0;
}

}  // namespace sphc
