// What differs between libcamera's releases, 0.0.3 (Debian 12) to 0.7, all in one place.  The rest of the plug-in
// says only what all of them understand:
//
//   since | change                                            | what the plug-in does
//   0.1   | StreamRoles is gone: generateConfiguration(Span)  | a braced list, which makes either
//   0.2   | transform became orientation                      | leaves both alone
//   0.5   | CameraManager::get takes a string_view            | looks the camera up in cameras()
//   0.5   | ExposureTimeMode beside AeEnable                  | controls are found by name while it runs, see below
//   0.6   | FrameBuffer::planes() is a Span, was a vector     | a range-based loop
//   0.6   | Request::addBuffer takes its fence as &&          | gives none
//   0.7   | Request::metadata() is const                      | reads by number
#pragma once

#include <libcamera/libcamera.h>

#include <string>

namespace sphc::libcamera_plugin {

// A control that the camera offers, by name: a symbol such as controls::ExposureTimeMode exists only in the
// releases that know it.  Null when the camera has none of that name.
inline const libcamera::ControlId *findControl(const libcamera::ControlInfoMap &offered, const std::string &name) {
  for (const auto &entry : offered)
    if (entry.first->name() == name) return entry.first;
  return nullptr;
}

}  // namespace sphc::libcamera_plugin
