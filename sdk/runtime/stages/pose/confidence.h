// The probability that a pose is within 5 cm and 5 degrees of the truth: a logistic model over what the search and
// the refinement tell of themselves.  docs/confidence.md says what it was fitted on and how well it holds
// elsewhere.
#pragma once
#include "runtime/types/estimate.h"

namespace sphc {

struct ConfidenceInputs {
  double log_odds = 0;            // of the search against chance: Estimate::log_odds
  double gain_share = 0;          // gain over correspondences with depth
  double inliers = 0;             // of the last refinement
  double spread_rad = 0;          // of their viewing rays
  double rotation_sigma_rad = 0;  // root of the covariance's trace
  double centre_sigma_m = 0;      // the same of the camera's place in the map
};

// `searched` gave the pose that `refined` then made better; the same when there was no second look.  Where depth
// was noisier than stated, the sigmas grow by as much.
ConfidenceInputs confidenceInputs(const Estimate &searched, const Estimate &refined);

// In [0, 1] whatever the inputs; 0 when one is not a number.  Never falls when log_odds, gain_share, inliers or
// spread_rad grow, or a sigma shrinks.
double confidenceOf(const ConfidenceInputs &inputs);

// For fitting: what the model weighs, each larger for a better pose, and its weights, none negative.
constexpr int kConfidenceFeatures = 6;
struct ConfidenceFeatures {
  double value[kConfidenceFeatures];
};
struct ConfidenceModel {
  double intercept;
  double weight[kConfidenceFeatures];
};
extern const char *const kConfidenceFeatureNames[kConfidenceFeatures];
const ConfidenceModel &confidenceModel();
// False when an input is not a number.
bool confidenceFeatures(const ConfidenceInputs &inputs, ConfidenceFeatures *features);
double confidenceFrom(const ConfidenceModel &model, const ConfidenceFeatures &features);

}  // namespace sphc
