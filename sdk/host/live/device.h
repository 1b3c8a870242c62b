// A camera, or what stands for one, chosen by a line of text:
//
//     v4l2:/dev/video0   v4l2:card=NAME   v4l2:bus=PLUG      one node, one stream
//     libcamera:   libcamera:ID                              the first camera, or this one; colour
//     openni2:   openni2:URI   openni2:walk.oni              the first device, or this one; colour and depth
//     replay:walk   replay:walk.mcap                         a recording, as fast as it was recorded
//     simulated:   simulated:feet,tiles,seed=7               the simulated headset, as fast as it renders
#pragma once
#include <spherecloud/spherecloud_capture.h>

#include <memory>
#include <string>

#include "host/recording/calibration.h"
#include "host/recording/recording_reader.h"

namespace sphc::host {

// What is wanted of a device.
struct Wish {
  bool color = true, depth = true;
  bool color_images = false;       // colours, not grey: to record
  uint32_t width = 0, height = 0;  // 0: a rig asks for those of the calibration, else 640 x 480
  uint32_t fps = 0;                // 0: whatever the camera does
  std::string calibration;         // of a recording that has none beside it
  bool at_once = false;            // a recording as fast as it can be read, not as it was recorded
  double tolerance_ms = 20;        // colour and depth of a recording's frame are at most so far apart
};

// Captures that may be out on loan at once: those that wait in a pairer, and those in use.
constexpr uint32_t kLoans = 6;

class Device {
 public:
  virtual ~Device() = default;
  Device() = default;
  Device(const Device &) = delete;
  Device &operator=(const Device &) = delete;

  const sphc_source &source() const { return source_; }
  // What was opened: "OV5640 (/dev/video0), YUYV 640 x 480 at 30 Hz".
  virtual std::string describe() const = 0;
  // What went wrong so far, in words; "" where nothing did.
  virtual std::string troubles() const { return ""; }
  // False where the device does not know its cameras.
  virtual bool calibration(sphc_rig * /*calibration*/) const { return false; }
  // Frames wait until they are asked for, so none need be skipped.
  virtual bool waits() const { return false; }
  // The recording that is played, opened once for both uses; null of all others.
  virtual recording::RecordingReader *replayed() const { return nullptr; }

 protected:
  sphc_source source_ = {};
};

// Throws std::runtime_error with cause and cure.
std::unique_ptr<Device> openDevice(const std::string &spec, const Wish &wish);

}  // namespace sphc::host
