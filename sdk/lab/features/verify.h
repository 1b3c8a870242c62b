// Matches between two images, held against the recorded poses.
#pragma once
#include "lab/features/frames.h"
#include "lab/features/variant.h"

namespace sphc::host {

struct FeatureMatch {
  uint32_t first, second;
};

// Of each feature of `a` the nearest of `b`, where it is nearer than `ratio` times the second nearest (Lowe 2004,
// section 7.1).
std::vector<FeatureMatch> matchByRatio(const FeaturesVariant &variant, const FoundFeatures &a,
                                       const FoundFeatures &b, double ratio);

// Sampson errors of matches, pixels: how far each pair is from meeting the epipolar constraint of the recorded
// poses (Hartley and Zisserman 2004, equation 11.9).  Matches without a ray through the camera are left out.
std::vector<double> sampsonErrors(const Camera &camera, const Rigid &b_from_a, const FoundFeatures &a,
                                  const FoundFeatures &b, const std::vector<FeatureMatch> &matches);

}  // namespace sphc::host
