// Cases of other sizes and shares of fakes, made from real ones.
#pragma once
#include "lab/pose/case.h"
#include "runtime/base/random.h"

namespace sphc::host {

// Fakes are made as the paper makes them: the direction of a true row, normal noise of variance 0.1 added,
// normalised.

// `count` rows with depth and none without: a random choice, or all and copies of random ones with half of the
// stated noise anew (copies of a fake row get a fake of their own).  True points grow alike.
PoseCase resizedCase(const PoseCase &original, size_t count, const CaseNoise &noise, Random *random);

// Fewer true rows, as many rows: true ones get a fake direction until `eta` is left.
PoseCase turnedCase(const PoseCase &original, double eta, Random *random);

// As many true rows, more rows: copies of random rows with a fake direction.
PoseCase dilutedCase(const PoseCase &original, double eta, Random *random);

}  // namespace sphc::host
