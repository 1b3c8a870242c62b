// Point models of a wanted size, to measure how cost grows with the map.  Of no use for maps that are shipped.
#pragma once
#include "host/import/point_model.h"
#include "host/publish/secret_random.h"

namespace sphc::host {

// Exactly `count` points.  Too many: those that most frames saw stay.  Too few: foreign points are added, whose
// descriptors are
//   1. those of `foreign`, points of other places, as they are, then
//   2. those of all points in mirror image, in negative, and both: what another place could look like, with the
//      statistics of real patches, while nothing here resembles them, then
//   3. those of 1 and 2 over again, each number times 1 + 0.45 n with n normal, scaled back to length 512: as
//      far from each other (about 230) as descriptors of one point in two frames may be.
// A foreign point lies about where some own point lies (a tenth of its distance from the centre away), so that
// directions spread like the real ones and the centre stays.  Throws std::runtime_error for a model without points.
PointModel resizedModel(const PointModel &own, const std::vector<PointModel> &foreign, size_t count,
                        SecretRandom *random);

}  // namespace sphc::host
