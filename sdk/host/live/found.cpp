#include "host/live/found.h"

#include "host/live/device_kind.h"

namespace sphc::host {

std::string nameAndOffers(const FoundCamera &camera) {
  return camera.name + (camera.name.empty() || camera.offers.empty() ? "" : ", ") + camera.offers;
}

Found findCameras() {
  Found found;
  for (const DeviceKind &kind : deviceKinds())
    if (kind.find) kind.find(&found);
  return found;
}

}  // namespace sphc::host
