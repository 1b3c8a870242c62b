#include "host/build/sphere_cloud.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "runtime/map/layout.h"

namespace sphc::host {
namespace {

template <typename T>
void shuffle(std::vector<T> *items, SecretRandom *random) {  // Fisher and Yates
  for (size_t i = items->size(); i > 1; --i) std::swap((*items)[i - 1], (*items)[random->below(i)]);
}

class GaussianFakes : public FakeStrategy {
 public:
  explicit GaussianFakes(double variance) : sigma_(std::sqrt(variance)) {}

  std::string name() const override { return "gaussian"; }

  std::vector<Vector3> fakes(const std::vector<Vector3> &real, size_t count, SecretRandom *random) const override {
    std::vector<Vector3> fakes;
    fakes.reserve(count);
    for (size_t k = 0; k < count; ++k) {
      const Vector3 &base = real[k % real.size()];
      Vector3 z;
      do {
        const double x = random->normal(), y = random->normal(), w = random->normal();
        z = base + sigma_ * Vector3(x, y, w);
      } while (!(z.norm() > 1e-6));
      fakes.push_back(z.normalized());
    }
    return fakes;
  }

 private:
  double sigma_;
};

Vector3 meanOf(const std::vector<ModelPoint> &points) {
  Vector3 sum = Vector3::Zero();
  for (const ModelPoint &point : points) sum += point.position_m;
  return sum / static_cast<double>(points.size());
}

void checkModel(const PointModel &model, const SphereCloudOptions &options) {
  if (!(options.eta > 0 && options.eta <= 1))
    throw std::runtime_error("eta is " + std::to_string(options.eta) + "; it must lie in (0, 1]");
  if (model.points.size() > kMapMaxPoints) throw std::runtime_error("the model has too many points for one map");
}

void checkCount(size_t points, double eta) {
  if (points < kMapMinPoints || eta * static_cast<double>(points) < 1)
    throw std::runtime_error("the model has " + std::to_string(points) +
                             " points, too few for a map; record more frames, slower, in better light");
}

}  // namespace

std::unique_ptr<FakeStrategy> gaussianFakes(double variance) {
  if (!(variance >= 0 && variance <= 100))
    throw std::runtime_error("sigma^2 is " + std::to_string(variance) + "; it must lie in [0, 100]");
  return std::make_unique<GaussianFakes>(variance);
}

SphereCloud makeSphereCloud(const PointModel &model, const SphereCloudOptions &options,
                            const FakeStrategy &strategy, SecretRandom *random, Vector3 *centre_m) {
  checkModel(model, options);
  checkCount(model.points.size(), options.eta);
  const Vector3 centre = meanOf(model.points);

  std::vector<SpherePoint> points;
  points.reserve(model.points.size());
  for (const ModelPoint &point : model.points) {
    const Vector3 offset = point.position_m - centre;
    if (offset.norm() > 1e-6)
      points.push_back({offset.normalized(), point.descriptor});  // at the centre: no direction
  }
  checkCount(points.size(), options.eta);
  shuffle(&points, random);
  const size_t real_count = static_cast<size_t>(options.eta * static_cast<double>(points.size()));

  std::vector<Vector3> real;
  real.reserve(real_count);
  for (size_t i = 0; i < real_count; ++i) real.push_back(points[i].direction);
  // Each discarded point lends its descriptor to a fake direction.
  const std::vector<Vector3> fakes = strategy.fakes(real, points.size() - real_count, random);
  for (size_t k = 0; k < fakes.size(); ++k) points[real_count + k].direction = fakes[k];

  shuffle(&points, random);
  *centre_m = centre;
  return {std::move(points)};
}

}  // namespace sphc::host
