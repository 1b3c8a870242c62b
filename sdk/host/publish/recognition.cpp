#include "host/publish/recognition.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/import/point_grid.h"
#include "host/publish/alignment.h"

namespace sphc::host {
namespace {

constexpr size_t kPaired = 12000;     // points of a model that look for their like
constexpr double kMostSlackM = 0.15;  // however uncertain two points are, no further apart are they one
constexpr double kCubeM = 0.1;

// What a model point at `position_m` of the place is.
Identity identityAt(const Vector3 &position_m, const ModelPoint &point, const Place &place, const PointGrid &grid) {
  Identity identity = Identity::kNew;
  const double farthest = kSamePoint.radius_m + kMostSlackM;
  grid.forEachNear(position_m, farthest, [&](size_t i, double distance_m) {
    const ModelPoint &known = place.points[i].seen;
    const double slack = std::min(kMostSlackM, 3 * std::hypot(point.sigma_m, known.sigma_m));
    if (identity == Identity::kKnown || distance_m > kSamePoint.radius_m + slack) return;
    const double apart = descriptorDistance(point.descriptor, known.descriptor);
    if (apart < kSamePoint.descriptor_distance)
      identity = Identity::kKnown;
    else if (apart < kMaybeSamePoint.descriptor_distance)
      identity = Identity::kAmbiguous;
  });
  return identity;
}

// Known where any of the alignments says so.
Identity identityOf(const ModelPoint &point, const std::vector<Similarity> &place_from_model, const Place &place,
                    const PointGrid &grid) {
  Identity identity = Identity::kNew;
  for (const Similarity &alignment : place_from_model) {
    const Identity here = identityAt(alignment * point.position_m, point, place, grid);
    if (here == Identity::kKnown) return here;
    if (here == Identity::kAmbiguous) identity = here;
  }
  return identity;
}

std::vector<PointPair> pairsOf(const Place &place, const PointModel &model) {
  std::vector<ModelPoint> known;
  for (const PlacePoint &point : place.points) known.push_back(point.seen);
  return pairByDescriptor(known, model.points, kPaired);
}

Recognition recognizeBy(std::vector<Similarity> place_from_model, const Place &place, const PointModel &model) {
  PointGrid grid(kCubeM);
  for (size_t i = 0; i < place.points.size(); ++i) grid.add(place.points[i].seen.position_m, i);
  Recognition recognition;
  recognition.place_from_model = std::move(place_from_model);
  for (const ModelPoint &point : model.points) {
    recognition.identities.push_back(identityOf(point, recognition.place_from_model, place, grid));
    recognition.known += recognition.identities.back() == Identity::kKnown;
  }
  return recognition;
}

}  // namespace

Recognition recognize(const Place &place, const PointModel &model) {
  return recognizeBy(alignments(pairsOf(place, model)), place, model);
}

double scaleToPlace(const Place &place, const PointModel &model, double least_known) {
  const double scale = otherScale(pairsOf(place, model));
  if (scale == 1) return 0;
  PointModel scaled = model;
  for (ModelPoint &point : scaled.points) {
    point.position_m *= scale;
    point.sigma_m *= scale;
  }
  const Recognition r = recognize(place, scaled);
  if (r.place_from_model.empty() || static_cast<double>(r.known) < least_known) return 0;
  return scale * r.place_from_model.front().scale;
}

bool shareAPoint(const Place &a, const Place &b) {
  PointModel model;
  for (const PlacePoint &point : b.points) model.points.push_back(point.seen);
  return recognize(a, model).known > 0 || scaleToPlace(a, model, 1) != 0;
}

size_t knownInPlaceFrame(const Place &place, const PointModel &model) {
  return recognizeBy({Similarity()}, place, model).known;
}

}  // namespace sphc::host
