#include "host/live/found.h"

#include "host/live/device_kind.h"

namespace sphc::host {

Found findCameras() {
  Found found;
  for (const DeviceKind &kind : deviceKinds())
    if (kind.find) kind.find(&found);
  return found;
}

}  // namespace sphc::host
