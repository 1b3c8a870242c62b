// Which points of a model keep their direction, and where the others pretend to be.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "host/build/secret_random.h"
#include "runtime/geometry/rotation.h"
#include "runtime/types/keypoint.h"

namespace sphc::host {

// All that leaves the owner's hands: no field in which a position, a colour or a count could hide.
struct SpherePoint {
  Vector3 direction;  // unit, from the centre
  Descriptor descriptor;
};

// What becomes of one point.  A fake carries the descriptor of the point it stands for.
struct Fate {
  bool real;
  Vector3 direction;  // unit; the point's own when real
};

class FakeStrategy {
 public:
  virtual ~FakeStrategy() = default;
  virtual std::string name() const = 0;
  // A fate a point, in order; `real_count` of them are real.  `points` are in an order that says nothing.
  virtual std::vector<Fate> fates(const std::vector<SpherePoint> &points, size_t real_count,
                                  SecretRandom *random) const = 0;
};

// The paper's: Gaussian noise on the coordinates of the real directions in turn, projected back to the sphere.
std::unique_ptr<FakeStrategy> gaussianFakes(double variance = 0.1);

}  // namespace sphc::host
