// Near-duplicates: points so near to each other and so alike that they are one, seen twice.
#pragma once
#include "host/import/point_model.h"

namespace sphc::host {

double descriptorDistance(const Descriptor &a, const Descriptor &b);  // L2 of bytes

struct NearDuplicateRule {
  double radius_m;
  double descriptor_distance;
};
constexpr NearDuplicateRule kModelNearDuplicates = {0.015, 220};  // of an imported model

// Keeps of each group of near-duplicates the one that most frames saw.  Most seen first in what comes out.
PointModel withoutNearDuplicates(PointModel model, const NearDuplicateRule &rule);

}  // namespace sphc::host
