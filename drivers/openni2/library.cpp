#include "library.h"

#include <cstring>
#include <mutex>

#include "explain.h"

namespace sphc::openni2 {

namespace {

// Two locks: OpenNI2 is called under the first, and calls back under the second.
std::mutex starting;
uint32_t starts = 0;
OniCallbackHandle callbacks;
std::mutex watching;
DeviceWatcher *watchers = nullptr;

}  // namespace

struct DeviceNews {
  template <typename Tell>
  static void tell(const OniDeviceInfo *info, Tell news) {
    if (!info) return;
    const std::lock_guard<std::mutex> lock(watching);
    for (DeviceWatcher *watcher = watchers; watcher; watcher = watcher->next_)
      if (!std::strncmp(watcher->uri_, info->uri, ONI_MAX_STR)) news(watcher);
  }
  static void ONI_CALLBACK_TYPE gone(const OniDeviceInfo *info, void *) {
    tell(info, [](DeviceWatcher *watcher) { watcher->onGone(); });
  }
  static void ONI_CALLBACK_TYPE state(const OniDeviceInfo *info, OniDeviceState its_state, void *) {
    tell(info, [=](DeviceWatcher *watcher) { watcher->onState(its_state); });
  }
};

sphc_status Library::start(sphc_message *message) {
  const std::lock_guard<std::mutex> lock(starting);
  if (starts == 0) {
    const OniStatus status = oniInitialize(ONI_API_VERSION);
    if (status != ONI_STATUS_OK) {
      explain(
          message, SPHC_E_DEVICE,
          "OpenNI2 cannot start (%s); install libopenni2-0, and the plug-in of the camera's maker into its folder "
          "OpenNI2/Drivers",
          LibraryError().text);
      oniShutdown();
      return SPHC_E_DEVICE;
    }
    OniDeviceCallbacks wanted = {nullptr, DeviceNews::gone, DeviceNews::state};
    oniRegisterDeviceCallbacks(&wanted, nullptr, &callbacks);
  }
  ++starts;
  started_ = true;
  return SPHC_OK;
}

Library::~Library() {
  if (!started_) return;
  const std::lock_guard<std::mutex> lock(starting);
  if (--starts != 0) return;
  oniUnregisterDeviceCallbacks(callbacks);
  oniShutdown();
}

bool DeviceWatcher::enroll(const char *uri) {
  const std::lock_guard<std::mutex> lock(watching);
  for (const DeviceWatcher *watcher = watchers; watcher; watcher = watcher->next_)
    if (!std::strncmp(watcher->uri_, uri, ONI_MAX_STR)) return false;
  copyText(uri_, uri);
  next_ = watchers;
  watchers = this;
  return true;
}

void DeviceWatcher::resign() {
  const std::lock_guard<std::mutex> lock(watching);
  for (DeviceWatcher **link = &watchers; *link; link = &(*link)->next_)
    if (*link == this) {
      *link = next_;
      return;
    }
}

sphc_openni2_device publicInfo(const OniDeviceInfo &info) {
  sphc_openni2_device device = {};
  copyText(device.uri, info.uri);
  copyText(device.vendor, info.vendor);
  copyText(device.name, info.name);
  return device;
}

LibraryError::LibraryError() : text{} {
  copyText(text, oniGetExtendedError());
  for (char *c = text; *c; ++c)
    if (*c == '\n' || *c == '\t') *c = c[1] ? ' ' : '\0';
}

}  // namespace sphc::openni2
