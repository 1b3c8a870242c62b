// The contract of sphc_source as a GoogleTest suite, for every driver, inside this tree or outside.
//
// A program of the suite is contract.cpp, a definition of driversUnderTest(), the driver and GoogleTest's main.  It
// is C++17 and needs Linux.  With CMake, linking SphereCloud::contract adds contract.cpp: docs/drivers.md, "A new
// driver".
#pragma once

#include <spherecloud/spherecloud_capture.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

namespace sphc::contract {

struct OpenedDriver {
  sphc_source source;
  std::shared_ptr<void> handle;  // closes the driver when the last copy goes
  // Where there is a device that can be pulled out, or made to send nothing.
  std::function<void()> unplug = nullptr, stall = nullptr;
};

struct Driver {
  std::string name;  // letters and digits
  std::function<OpenedDriver()> open;
  uint32_t captures_until_end = 0;  // 0: endless
  bool opens_twice = true;          // two at the same time; a real device cannot
  uint32_t streams = 2;             // that come; a camera of colour or depth alone has one
  uint32_t spare_buffers = 0;       // beyond those that may be on loan
  bool is_live = true;              // times are of now; those of a recording and of a fake are not
  bool may_end = false;             // after captures that nobody has counted
  bool gives_amplitudes = false;    // with some depth captures
};
inline void PrintTo(const Driver &driver, std::ostream *out) { *out << driver.name; }  // NOLINT: GoogleTest's name

// Yours: each program of the suite has its own.
std::vector<Driver> driversUnderTest();

}  // namespace sphc::contract
