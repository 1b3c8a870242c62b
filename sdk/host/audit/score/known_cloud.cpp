#include "host/audit/score/known_cloud.h"

namespace sphc::host {

KnownCloud knownCloud(const std::vector<Assignment> &assignments) {
  KnownCloud cloud;
  for (const Assignment &assignment : assignments) {
    cloud.published.directions.push_back(assignment.shown.direction);
    cloud.published.descriptors.push_back(assignment.shown.descriptor);
    cloud.real.push_back(assignment.real);
    cloud.patches.push_back(assignment.patch);
  }
  return cloud;
}

}  // namespace sphc::host
