#include "host/audit/score/object.h"

#include <algorithm>

namespace sphc::host {

std::vector<Descriptor> objectIn(std::vector<ModelPoint> frame, uint32_t around) {
  const Vector3 middle = frame[around].position_m;
  std::sort(frame.begin(), frame.end(), [&](const ModelPoint &a, const ModelPoint &b) {
    return (a.position_m - middle).squaredNorm() < (b.position_m - middle).squaredNorm();
  });
  frame.resize(std::min(frame.size(), kObjectPoints));
  std::vector<Descriptor> object;
  for (const ModelPoint &point : frame) object.push_back(point.descriptor);
  return object;
}

}  // namespace sphc::host
