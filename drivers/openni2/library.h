// What OpenNI2 has once in a process: its start, the news of devices, and which of them are open here.
#pragma once

#include <OniCAPI.h>

#include "openni2.h"

namespace sphc::openni2 {

// Starts OpenNI2 for as long as it lives; any number of them, in any threads.
class Library {
 public:
  Library() = default;
  ~Library();
  Library(const Library &) = delete;
  Library &operator=(const Library &) = delete;

  sphc_status start(sphc_message *message);

 private:
  bool started_ = false;
};

// Hears of one device, on threads of OpenNI2, while it is enrolled.
class DeviceWatcher {
 public:
  virtual void onGone() = 0;
  virtual void onState(OniDeviceState state) = 0;

  // False: that device has a watcher already.
  bool enroll(const char *uri);
  void resign();

 protected:
  virtual ~DeviceWatcher() = default;

 private:
  friend struct DeviceNews;
  char uri_[ONI_MAX_STR] = "";
  DeviceWatcher *next_ = nullptr;
};

// As the public header has it.
sphc_openni2_device publicInfo(const OniDeviceInfo &info);

// OpenNI2's own words about the last failure of this thread, in one line; "" when it has none.
struct LibraryError {
  LibraryError();
  char text[128];
};

}  // namespace sphc::openni2
