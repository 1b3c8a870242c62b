// Which points of a model keep their direction, and where the others pretend to be.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "host/publish/secret_random.h"
#include "runtime/geometry/rotation.h"
#include "runtime/types/keypoint.h"

namespace sphc::host {

// All that leaves the owner's hands: no field in which a position, a colour or a count could hide.
struct SpherePoint {
  Vector3 direction;  // unit, from the centre
  Descriptor descriptor;
};

// What becomes of one point.
struct Assignment {
  bool real;
  SpherePoint shown;   // what the map says; the point itself when real
  uint32_t patch = 0;  // with which it came, of strategies that move whole patches; nobody else learns it
};

class FakeStrategy {
 public:
  virtual ~FakeStrategy() = default;
  virtual std::string name() const = 0;
  // That of FakeOptions which shapes these fakes.
  virtual double option() const = 0;
  // A assignment a point, in order.  About `real_count` of them are real, and at least one.  `points` come in an
  // order that says nothing.
  virtual std::vector<Assignment> assignments(const std::vector<SpherePoint> &points, size_t real_count,
                                              SecretRandom *random) const = 0;
};

// What the strategies can be told.
struct FakeOptions {
  double sigma2 = 0.1;   // of gaussian
  double patch_deg = 8;  // of patchwork and warped
};

constexpr char kDefaultFakes[] = "patchwork";
std::vector<std::string> fakeNames();
// Throws std::runtime_error, with cause and cure, for another name or an option out of range.
std::unique_ptr<FakeStrategy> makeFakes(const std::string &name, const FakeOptions &options = {});

// The paper's: Gaussian noise on the coordinates of the real directions in turn, projected back to the sphere.
std::unique_ptr<FakeStrategy> gaussianFakes(double variance = FakeOptions().sigma2);

// docs/fakes.md: the sphere is cut into patches about `patch_deg` wide.  Those that stay are real, point for point;
// each of the others is laid on one of them in mirror image, descriptors too, turned at random.  So a fake is among
// the company it had, and no camera sees it from anywhere.
std::unique_ptr<FakeStrategy> patchworkFakes(double patch_deg = FakeOptions().patch_deg);

// Patchwork that lays each patch on one beside which it lies, and warps it smoothly on its way.
std::unique_ptr<FakeStrategy> warpedFakes(double patch_deg = FakeOptions().patch_deg);

}  // namespace sphc::host
