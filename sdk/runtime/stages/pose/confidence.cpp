#include "runtime/stages/pose/confidence.h"

#include "runtime/base/elementary.h"

namespace sphc {
namespace {

constexpr double kTolerableM = 0.05, kTolerableRad = 5 * kPi / 180;
constexpr double kPinnedDown = 3;  // so many inliers agree with any pose that was made from them

// As `spherecloud-lab confidence --fit` prints it for the files that docs/confidence.md names.
constexpr ConfidenceModel kModel = {-5.8707, {1.5177, 2.7420, 4.5797, 1.9555}};

double clamped(double value, double low, double high) { return value < low ? low : value > high ? high : value; }
double logWithin(double value, double low, double high) { return logOf(clamped(value, low, high)); }

// A variance below zero is no variance.
double sigmaOf(double variance) { return variance >= 0 ? sqrtOf(variance) : __builtin_nan(""); }

}  // namespace

const ConfidenceModel &confidenceModel() { return kModel; }

ConfidenceInputs confidenceInputs(const Estimate &searched, const Estimate &refined) {
  const double noise = refined.noise_ratio > 1 ? refined.noise_ratio : 1;
  ConfidenceInputs inputs;
  inputs.gain_share = searched.lifted > 0 ? searched.gain / searched.lifted : 0;
  inputs.inliers = searched.inliers;
  inputs.gain_per_inlier = searched.inliers > 0 ? searched.gain / searched.inliers : 0;
  inputs.rotation_sigma_rad = noise * sigmaOf(refined.covariance.topLeftCorner<3, 3>().trace());
  inputs.centre_sigma_m = noise * sigmaOf(refined.covariance.bottomRightCorner<3, 3>().trace());
  return inputs;
}

// Each input is limited to the range in which more of it says more.
bool confidenceFeatures(const ConfidenceInputs &inputs, ConfidenceFeatures *features) {
  const double rotation = inputs.rotation_sigma_rad / kTolerableRad, centre = inputs.centre_sigma_m / kTolerableM;
  for (double input : {inputs.gain_share, inputs.inliers, inputs.gain_per_inlier, rotation, centre})
    if (input != input) return false;
  *features = {{logWithin(inputs.gain_share, 0.01, 1), logWithin(inputs.inliers - kPinnedDown, 0.3, 20),
                clamped(inputs.gain_per_inlier, 0, 1),
                -logWithin(rotation > centre ? rotation : centre, 0.02, 10)}};
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
