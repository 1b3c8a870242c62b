#include "host/publish/sphere_cloud.h"

#include <stdexcept>
#include <utility>

#include "runtime/map/layout.h"

namespace sphc::host {
namespace {

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

Vector3 centreOf(const std::vector<ModelPoint> &points) {
  Vector3 sum = Vector3::Zero();
  for (const ModelPoint &point : points) sum += point.position_m;
  return sum / static_cast<double>(points.size());
}

SpherePoint seenFrom(const Vector3 &centre_m, const ModelPoint &point) {
  return {(point.position_m - centre_m).normalized(), point.descriptor};
}

SphereCloud makeSphereCloud(const PointModel &model, const SphereCloudOptions &options,
                            const FakeStrategy &strategy, SecretRandom *random, Vector3 *centre_m) {
  checkModel(model, options);
  checkCount(model.points.size(), options.eta);
  const Vector3 centre = centreOf(model.points);

  std::vector<SpherePoint> points;
  points.reserve(model.points.size());
  for (const ModelPoint &point : model.points)
    if ((point.position_m - centre).norm() > 1e-6)  // at the centre: no direction
      points.push_back(seenFrom(centre, point));
  checkCount(points.size(), options.eta);
  shuffle(&points, random);
  const size_t real_count = static_cast<size_t>(options.eta * static_cast<double>(points.size()));

  const std::vector<Assignment> assignments = strategy.assignments(points, real_count, random);
  for (size_t i = 0; i < points.size(); ++i) points[i] = assignments[i].shown;

  shuffle(&points, random);
  *centre_m = centre;
  return {std::move(points)};
}

}  // namespace sphc::host
