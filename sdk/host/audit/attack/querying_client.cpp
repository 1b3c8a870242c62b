#include "host/audit/attack/querying_client.h"

#include <cmath>

#include "host/audit/attack/descriptor_pairs.h"

namespace sphc::host {
namespace {

constexpr double kAngle_rad = 0.02, kRatio = 0.9;

}  // namespace

void QueryingClient::query(const std::vector<OwnPoint> &frame) {
  std::vector<Descriptor> descriptors;
  for (const OwnPoint &point : frame) descriptors.push_back(point.descriptor);
  for (const EntryPair &pair : pairEntries(descriptors, map_.descriptors, kRatio)) {
    const Vector3 &own = frame[pair.a].position_m, &direction = map_.directions[pair.b];
    const double along = own.dot(direction);
    if (along > std::cos(kAngle_rad) * own.norm() && !learned_[pair.b]) learned_[pair.b] = along * direction;
  }
}

}  // namespace sphc::host
