// A plug-in of the libcamera driver without libcamera: cameras that exist in memory, and do as a test says.  It is
// a shared library that the driver opens like the real one; a test gets at its strings with the symbol below.
#pragma once

#include <cstdint>

#include "drivers/libcamera/plugin.h"

namespace sphc::contract {

struct FakeControl {
  const char *name;
  int64_t min, max;
  int64_t value;  // that was set; INT64_MIN: never
};

constexpr uint32_t kFakeControls = 4;
constexpr int64_t kNeverSet = INT64_MIN;

struct FakeLibcamera {
  // What the cameras offer.
  char pixel_format[5] = "YUYV";
  uint32_t buffers = 4;
  uint32_t other_width = 0;                  // instead of the width that is asked for; 0: that one
  FakeControl controls[kFakeControls] = {};  // null names: not offered
  bool speaks_our_version = true;
  bool cannot_start = false;
  bool refuses_settings = false;

  // What goes wrong with frames to come.
  bool stalled = false;
  bool unplugged = false;
  bool next_damaged = false;
  bool refuses_next = false;   // of what was queued
  uint32_t skip = 0;           // sequence numbers, once
  uint64_t missing_bytes = 0;  // of the next frame
  int64_t time_shift_ns = 0;   // of every time
  bool gives_time = true;
  int64_t exposure_us = 0;  // as the camera tells it

  // What the driver did.
  uint32_t open_devices = 0, running_devices = 0;
};

constexpr const char *kFakeLibcameraSymbol = "sphc_fake_libcamera";
using FakeLibcameraFn = FakeLibcamera *(*)();

}  // namespace sphc::contract
