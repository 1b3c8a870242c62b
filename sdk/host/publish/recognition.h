// Is this a place that we know, and which of its points are these?
#pragma once
#include <vector>

#include "host/import/near_duplicates.h"
#include "host/publish/place.h"
#include "host/publish/similarity.h"

namespace sphc::host {

// Of one release, merged before it: near-duplicates give each other away.
constexpr NearDuplicateRule kReleaseNearDuplicates = {0.06, 200};
// Points of a place are never published beside these: the radius grows with the points' own uncertainty.
constexpr NearDuplicateRule kSamePoint = {0.06, 260};
// Near, but only somewhat alike: it may be the same point, so it is left out.
constexpr NearDuplicateRule kMaybeSamePoint = {0.06, 340};

enum class Identity : uint8_t { kNew, kKnown, kAmbiguous };

struct Recognition {
  // Of the model's frame, largest support first, then those of things that were moved since.  Empty: another place.
  std::vector<Similarity> place_from_model;
  std::vector<Identity> identities;  // of each model point
  size_t known = 0;
};

// By descriptors that match and positions that agree, whatever frame the model is in.
Recognition recognize(const Place &place, const PointModel &model);

// The same room in another unit: what the model has to be multiplied by to show so many points of the place or
// more; 0 where that is not so, or where it is a metric model of it as it stands.
double scaleToPlace(const Place &place, const PointModel &model, double least_known);

// Whether two places have points in common: one was published anew, in whatever frame and unit.
bool shareAPoint(const Place &a, const Place &b);

// Points that the place has where the model says, whose world is the place's.
size_t knownInPlaceFrame(const Place &place, const PointModel &model);

}  // namespace sphc::host
