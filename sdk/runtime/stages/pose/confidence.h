// The probability that a pose is within 5 cm and 5 degrees of the truth: logistic regression on what the search and
// the refinement tell of themselves.  docs/confidence.md says what it was fitted on, and how well it holds
// elsewhere.
#pragma once
#include "runtime/types/estimate.h"

namespace sphc {

struct ConfidenceInputs {
  double gain_share = 0;          // Estimate::gain over correspondences with depth
  double inliers = 0;             // correspondences
  double gain_per_inlier = 0;     // 0.83 on average where the noise is as stated, less where agreement is chance
  double rotation_sigma_rad = 0;  // root of the covariance's trace
  double centre_sigma_m =
      0;  // the same: of the camera's place in the map, which the translation part of xi moves alone
};

// `searched` gave the pose, and `refined` then made it better: the same without guided re-matching.  Agreement
// is taken from the first, which had the whole map to choose from, precision from the second.  Where depth was
// noisier than stated, the sigmas grow by as much.
ConfidenceInputs confidenceInputs(const Estimate &searched, const Estimate &refined);

// In [0, 1] whatever the inputs; 0 when one is not a number.  Never falls when gain_share, inliers or
// gain_per_inlier grow, or a sigma shrinks.
double confidenceOf(const ConfidenceInputs &inputs);

// For fitting: what the model weighs, each larger for a better pose, and its weights, none negative.
constexpr int kConfidenceFeatures = 4;
struct ConfidenceFeatures {
  double value[kConfidenceFeatures];
};
struct ConfidenceModel {
  double intercept;
  double weight[kConfidenceFeatures];
};
const ConfidenceModel &confidenceModel();
// False when an input is not a number.
bool confidenceFeatures(const ConfidenceInputs &inputs, ConfidenceFeatures *features);
double confidenceFrom(const ConfidenceModel &model, const ConfidenceFeatures &features);

}  // namespace sphc
