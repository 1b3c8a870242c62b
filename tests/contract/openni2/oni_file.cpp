#include "oni_file.h"

#include <OniCAPI.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "tests/support/openni2/virtual_tof.h"

namespace sphc::contract {

namespace {

constexpr int kIndices = 255 - kPairsAtLeast;
constexpr uintmax_t kSomeFramesBytes = 500000;

bool emitFrame(OniSensorType sensor, int index) {
  vtof::Frame frame = {};
  frame.sensor = sensor;
  frame.index = index;
  frame.timestamp_us = static_cast<uint64_t>(index) * vtof::kPeriodUs;
  return vtof::emit(0, frame);
}

// Emits until the file shows that the recorder is awake.
int wakeRecorder(const std::string &path, bool with_color) {
  int index = 0;
  while (index < kIndices && std::filesystem::file_size(path) < kSomeFramesBytes) {
    ++index;
    if (with_color) emitFrame(ONI_SENSOR_COLOR, index);
    emitFrame(ONI_SENSOR_DEPTH, index);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return index < kIndices ? index : 0;
}

int emitAll(const std::string &path, bool color_begins_late) {
  const int awake = wakeRecorder(path, !color_begins_late);
  if (awake == 0) return 0;
  for (int index = awake + 1; index <= awake + kPairsAtLeast; ++index)
    if (!emitFrame(ONI_SENSOR_COLOR, index) || !emitFrame(ONI_SENSOR_DEPTH, index)) return 0;
  return awake + kPairsAtLeast;
}

bool makePlain(OniStreamHandle stream) {
  const OniBool off = FALSE;
  const OniCropping whole = {};
  return oniStreamSetProperty(stream, ONI_STREAM_PROPERTY_MIRRORING, &off, sizeof off) == ONI_STATUS_OK &&
         oniStreamSetProperty(stream, ONI_STREAM_PROPERTY_CROPPING, &whole, sizeof whole) == ONI_STATUS_OK;
}

}  // namespace

int writeOniFile(const std::string &path, bool color_begins_late) {
  OniDeviceHandle device = nullptr;
  OniStreamHandle color = nullptr, depth = nullptr;
  OniRecorderHandle recorder = nullptr;
  const bool started =
      oniInitialize(ONI_API_VERSION) == ONI_STATUS_OK && oniDeviceOpen(vtof::uri(0), &device) == ONI_STATUS_OK &&
      oniDeviceCreateStream(device, ONI_SENSOR_COLOR, &color) == ONI_STATUS_OK &&
      oniDeviceCreateStream(device, ONI_SENSOR_DEPTH, &depth) == ONI_STATUS_OK && makePlain(color) &&
      makePlain(depth) && oniCreateRecorder(path.c_str(), &recorder) == ONI_STATUS_OK &&
      oniRecorderAttachStream(recorder, depth, FALSE) == ONI_STATUS_OK &&
      oniRecorderAttachStream(recorder, color, FALSE) == ONI_STATUS_OK &&
      oniRecorderStart(recorder) == ONI_STATUS_OK && oniStreamStart(color) == ONI_STATUS_OK &&
      oniStreamStart(depth) == ONI_STATUS_OK;
  const int last = started ? emitAll(path, color_begins_late) : 0;
  if (recorder) {
    oniRecorderStop(recorder);
    oniRecorderDestroy(&recorder);
  }
  for (const OniStreamHandle stream : {color, depth})
    if (stream) oniStreamDestroy(stream);
  if (device) oniDeviceClose(device);
  oniShutdown();
  return last;
}

}  // namespace sphc::contract
