#include "host/publish/sphere_cloud.h"

namespace sphc::host {

Vector3 centreOf(const std::vector<ModelPoint> &points) {
  Vector3 sum = Vector3::Zero();
  for (const ModelPoint &point : points) sum += point.position_m;
  return sum / static_cast<double>(points.size());
}

SpherePoint seenFrom(const Vector3 &centre_m, const ModelPoint &point) {
  return {(point.position_m - centre_m).normalized(), point.descriptor};
}

}  // namespace sphc::host
