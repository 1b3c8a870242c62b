// A USB Video Class 1.0 camera in user space: descriptors, control requests and payloads of one bulk endpoint.
// Plays recorded frames byte for byte.  It knows nothing of what carries it: vhci_main.cpp and redirect_main.cpp
// do.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace sphc::guest {

constexpr uint32_t kMostPayloadBytes = 16384;  // one request of the kernel's driver: 32 packets of 512 bytes
constexpr uint16_t kBulkPacketBytes = 512;
constexpr uint8_t kBulkEndpoint = 1;  // towards the host: address 0x81
constexpr uint16_t kVendorId = 0x1209, kProductId = 0x0001;

struct CameraOptions {
  std::string name;    // the product string; the kernel names the video node after it
  std::string fourcc;  // YUYV, Z16 or GREY
  uint32_t width = 0, height = 0;
  uint32_t rate_hz = 10;
  std::string
      frames_file;  // raw frames one behind the other, played in a ring from the first at every stream start
  int64_t unplug_after = -1;  // frames sent, in all; -1: never
  int64_t stall_after = -1;   // from then on it stays plugged in and sends nothing
  int64_t cut_frame = -1;     // of this frame of every stream only the first half is sent
  // Bits: 1 manual, 2 automatic, 4 shutter priority, 8 aperture priority, which libcamera takes for automatic; but
  // v4l2-compliance fails on a camera that ends in a mode other than manual when it has tried all.
  uint32_t exposure_modes = 3;
  std::string where;  // port of the virtual bus, or socket
};

// "--name X --format YUYV --size 640x480 ..."; explains on stderr and exits when they make no sense.
CameraOptions parseOptions(int argc, char **argv, const char *where_option);

struct SetupPacket {
  uint8_t request_type, request;
  uint16_t value, index, length;
};

class UvcCamera {
 public:
  explicit UvcCamera(CameraOptions options);

  // A request on endpoint 0.  `data` (4 KiB) holds what the host sent, or takes what it is to get.  Gives the bytes
  // for the host; -1: the camera refuses.
  int control(const SetupPacket &setup, uint8_t *data);

  // A frame period has passed: the next frame is ready to be sent, if the one before is gone.
  void tick();
  // The next piece of the frame, with its header; 0 while there is none.
  uint32_t nextPayload(uint8_t *payload, uint32_t room_bytes);
  // The host gave up what it had asked for: what is left of the frame is dropped.
  void abandonFrame() { sending_ = false; }

  bool isSending() const { return sending_; }
  bool cableIsPulled() const { return pulled_; }
  uint32_t rateHz() const { return options_.rate_hz; }
  const std::string &name() const { return options_.name; }

 private:
  void buildConfiguration();
  int standardRequest(const SetupPacket &setup, uint8_t *data) const;
  int descriptor(uint8_t type, uint8_t index, uint8_t *data) const;
  int streamingRequest(const SetupPacket &setup, uint8_t *data);
  int cameraRequest(const SetupPacket &setup, uint8_t *data);
  std::array<uint8_t, 26> streamParameters() const;

  CameraOptions options_;
  uint32_t frame_bytes_ = 0;
  std::vector<uint8_t> frames_;
  std::vector<uint8_t> configuration_;
  std::vector<uint32_t> controls_;  // current values, in the order of kControls

  int64_t sent_ = 0;        // frames, in all
  int64_t next_frame_ = 0;  // of this stream
  const uint8_t *frame_ = nullptr;
  uint32_t offset_ = 0, end_ = 0;
  uint32_t frame_time_us_ = 0;
  uint8_t frame_parity_ = 0;
  bool sending_ = false;
  bool pulled_ = false;
};

}  // namespace sphc::guest
