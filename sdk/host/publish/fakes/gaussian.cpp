#include <cmath>
#include <stdexcept>

#include "host/publish/fakes/strategy.h"

namespace sphc::host {
namespace {

class GaussianFakes : public FakeStrategy {
 public:
  explicit GaussianFakes(double variance) : variance_(variance), sigma_(std::sqrt(variance)) {}

  std::string name() const override { return "gaussian"; }
  double option() const override { return variance_; }

  std::vector<Assignment> assignments(const std::vector<SpherePoint> &points, size_t real_count,
                                      SecretRandom *random) const override {
    std::vector<Assignment> assignments;
    assignments.reserve(points.size());
    for (size_t i = 0; i < real_count; ++i) assignments.push_back({true, points[i]});
    for (size_t i = real_count; i < points.size(); ++i)
      assignments.push_back(
          {false, {near(points[(i - real_count) % real_count].direction, random), points[i].descriptor}});
    return assignments;
  }

 private:
  Vector3 near(const Vector3 &base, SecretRandom *random) const {
    Vector3 z;
    do {
      const double x = random->normal(), y = random->normal(), w = random->normal();
      z = base + sigma_ * Vector3(x, y, w);
    } while (!(z.norm() > 1e-6));
    return z.normalized();
  }

  double variance_, sigma_;
};

}  // namespace

std::unique_ptr<FakeStrategy> gaussianFakes(double variance) {
  if (!(variance >= 0 && variance <= 100))
    throw std::runtime_error("sigma^2 is " + std::to_string(variance) + "; it must lie in [0, 100]");
  return std::make_unique<GaussianFakes>(variance);
}

}  // namespace sphc::host
