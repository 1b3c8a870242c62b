#include "host/audit/score/known_cloud.h"

namespace sphc::host {

KnownCloud knownCloud(const std::vector<Fate> &fates) {
  KnownCloud cloud;
  for (const Fate &fate : fates) {
    cloud.published.directions.push_back(fate.shown.direction);
    cloud.published.descriptors.push_back(fate.shown.descriptor);
    cloud.real.push_back(fate.real);
  }
  return cloud;
}

}  // namespace sphc::host
