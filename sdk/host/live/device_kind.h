// A kind of camera: how one is opened, and how those that are there are found.  Each has a file of its own; where
// this build lacks the driver, the build makes one from device_absent.cpp.in.
#pragma once
#include <array>
#include <memory>
#include <string>

#include "host/live/device.h"
#include "host/live/found.h"

namespace sphc::host {

struct DeviceKind {
  const char *name;                                                               // what stands before the colon
  std::unique_ptr<Device> (*open)(const std::string &address, const Wish &wish);  // throws as openDevice does
  void (*find)(Found *found);  // adds the cameras of this machine; null: there is nothing to find
};

DeviceKind v4l2Kind();
DeviceKind libcameraKind();
DeviceKind openni2Kind();
DeviceKind replayKind();
DeviceKind simulatedKind();

inline std::array<DeviceKind, 5> deviceKinds() {
  return {v4l2Kind(), libcameraKind(), openni2Kind(), replayKind(), simulatedKind()};
}

}  // namespace sphc::host
