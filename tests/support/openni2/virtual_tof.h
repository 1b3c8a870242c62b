// A virtual ToF camera, "vtof://0" and "vtof://1", as a driver plug-in of OpenNI2, and the strings that a test
// pulls: the test links the plug-in and so shares it with OpenNI2, which loads the same file.  Nothing happens by
// itself unless run() is told: frames come when they are emitted, so that tests need no clock.
#pragma once

#include <OniCTypes.h>

#include <cstdint>

#define VTOF_API __attribute__((visibility("default")))

namespace sphc::vtof {

constexpr int kDevices = 2;
inline const char *uri(int device) { return device == 0 ? "vtof://0" : "vtof://1"; }

// One frame as the plug-in hands it over.  Zeros: of the stream's mode.
struct Frame {
  OniSensorType sensor;
  int index;
  uint64_t timestamp_us;
  const void *pixels;  // rows without gaps; null: pattern(index)
  int width, height, stride_bytes, data_bytes;
  OniPixelFormat format;
};

// How the device misbehaves.
struct Faults {
  bool grants_another_mode;
  bool refuses_modes;
  bool cannot_register;       // the property is not there
  bool ignores_registration;  // says yes and does nothing
  bool stays_mirrored;
  bool keeps_exposure;  // takes a value and keeps the old one
  bool does_not_start;
  bool does_not_open;
  bool refuses_sync;
};

// All devices plugged in, silent, without faults, as new.
VTOF_API void reset();
VTOF_API void setFaults(int device, const Faults &faults);

// Each comes back when OpenNI2 has told everyone; told by a thread of the plug-in's own, as with real devices.
VTOF_API void unplug(int device);
VTOF_API void plug(int device);
VTOF_API void changeState(int device, OniDeviceState state);

// False: no such stream runs.
VTOF_API bool emit(int device, const Frame &frame);
// Colour and depth of one index, depth `depth_lag_us` later, times 33333 us apart.
constexpr uint64_t kPeriodUs = 33333;
VTOF_API void emitPair(int device, int index, uint64_t depth_lag_us = 0);
// Emits pairs by itself until told not to, or the device is unplugged.
VTOF_API void run(int device, bool on);

// Byte `i` of the pixels of frame `index` without pixels of its own.
// Depth stays below 8192: recorders garble what is beyond the device's maximum.
inline uint8_t pattern(OniSensorType sensor, int index, size_t i) {
  const uint8_t byte = static_cast<uint8_t>(31 * static_cast<size_t>(index) + i % 251);
  return sensor == ONI_SENSOR_DEPTH && i % 2 != 0 ? byte % 32 : byte;
}

// The index, below 256, of the frame whose pattern begins with this byte.
inline int indexOf(uint8_t first_byte) {
  constexpr int kInverse = 223;  // of 31, modulo 256
  return first_byte * kInverse % 256;
}

// What the plug-in was last told.
VTOF_API bool registered(int device);
VTOF_API int syncedStreams();

}  // namespace sphc::vtof
