// From private points to a publishable sphere cloud: the paper's algorithm 1 (supplement, section 1.3).
#pragma once
#include <vector>

#include "host/import/point_model.h"
#include "host/publish/fakes/strategy.h"
#include "host/publish/secret_random.h"

namespace sphc::host {

struct SphereCloudOptions {
  double eta = 1.0 / 3;  // share of points that keep their direction; (0, 1]
};

struct SphereCloud {
  std::vector<SpherePoint> points;  // real and fake, shuffled
};

// Where a new map of these points has its centre: their mean.
Vector3 centreOf(const std::vector<ModelPoint> &points);
SpherePoint seenFrom(const Vector3 &centre_m, const ModelPoint &point);

// `centre_m` receives the sphere centre in the model's world frame: for the owner, not for the map.
// Throws std::runtime_error, with cause and cure, when the model cannot make a map.
SphereCloud makeSphereCloud(const PointModel &model, const SphereCloudOptions &options,
                            const FakeStrategy &strategy, SecretRandom *random, Vector3 *centre_m);

}  // namespace sphc::host
