// From private points to a publishable sphere cloud: the paper's algorithm 1 (supplement, section 1.3).
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "host/build/secret_random.h"
#include "host/import/point_model.h"

namespace sphc::host {

// All that leaves the owner's hands: no field in which a position, a colour or a count could hide.
struct SpherePoint {
  Vector3 direction;  // unit, from the centre
  Descriptor descriptor;
};

// Makes the directions of fake points; the paper's is the first of several.
class FakeStrategy {
 public:
  virtual ~FakeStrategy() = default;
  virtual std::string name() const = 0;
  // `count` directions from the real ones that stay.
  virtual std::vector<Vector3> fakes(const std::vector<Vector3> &real, size_t count,
                                     SecretRandom *random) const = 0;
};

// Gaussian noise on the coordinates of the real directions in turn, projected back to the sphere; sigma^2 = 0.1.
std::unique_ptr<FakeStrategy> gaussianFakes(double variance = 0.1);

struct SphereCloudOptions {
  double eta = 1.0 / 3;  // share of points that keep their direction; (0, 1]
};

struct SphereCloud {
  std::vector<SpherePoint> points;  // real and fake, shuffled
};

// `centre_m` receives the sphere centre in the model's world frame: for the owner, not for the map.
// Throws std::runtime_error, with cause and cure, when the model cannot make a map.
SphereCloud makeSphereCloud(const PointModel &model, const SphereCloudOptions &options,
                            const FakeStrategy &strategy, SecretRandom *random, Vector3 *centre_m);

}  // namespace sphc::host
