#include "uvc_camera.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "clock_us.h"

namespace sphc::guest {

namespace {

constexpr uint8_t kVideoControl = 0, kVideoStreaming = 1;    // interfaces
constexpr uint8_t kCameraTerminal = 1, kProcessingUnit = 2;  // entities of the first

enum Request : uint8_t {
  kSetCur = 0x01,
  kGetCur = 0x81,
  kGetMin = 0x82,
  kGetMax = 0x83,
  kGetRes = 0x84,
  kGetLen = 0x85,
  kGetInfo = 0x86,
  kGetDef = 0x87
};

constexpr uint8_t kManual = 1;       // an auto-exposure mode
constexpr size_t kExposureMode = 0;  // its place in the table

struct ControlSpec {
  uint8_t entity, selector, bytes;
  uint32_t min, max, step, def;
};
constexpr ControlSpec kControls[] = {
    {kCameraTerminal, 0x02, 1, 0, 0, 0, kManual},  // auto-exposure mode; its step lists the modes there are
    {kCameraTerminal, 0x04, 4, 1, 10000, 1, 100},  // exposure time, 100 us
    {kProcessingUnit, 0x02, 2, 0, 255, 1, 128},    // brightness
    {kProcessingUnit, 0x04, 2, 0, 255, 1, 10},     // gain
};

void put16(std::vector<uint8_t> &out, uint32_t value) {
  out.push_back(static_cast<uint8_t>(value));
  out.push_back(static_cast<uint8_t>(value >> 8));
}
void put32(std::vector<uint8_t> &out, uint32_t value) {
  put16(out, value);
  put16(out, value >> 16);
}
void put(std::vector<uint8_t> &out, std::initializer_list<int> bytes) {
  for (const int byte : bytes) out.push_back(static_cast<uint8_t>(byte));
}
void patch16(std::vector<uint8_t> &out, size_t at, size_t value) {
  out[at] = static_cast<uint8_t>(value);
  out[at + 1] = static_cast<uint8_t>(value >> 8);
}
void write32(uint8_t *out, uint32_t value) {
  for (int i = 0; i < 4; ++i) out[i] = static_cast<uint8_t>(value >> (8 * i));
}

// Formats are named by a GUID that begins with four letters.
const char *guidLetters(const std::string &fourcc) {
  if (fourcc == "YUYV") return "YUY2";
  if (fourcc == "Z16") return "Z16 ";
  if (fourcc == "GREY") return "Y800";
  throw std::runtime_error("format " + fourcc + ": known are YUYV, Z16, GREY");
}

std::vector<uint8_t> readFile(const std::string &path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw std::runtime_error(path + ": cannot be read");
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

int giveString(const std::string &text, uint8_t *data) {
  const size_t length = 2 + 2 * text.size();
  data[0] = static_cast<uint8_t>(length);
  data[1] = 3;
  for (size_t i = 0; i < text.size(); ++i) {
    data[2 + 2 * i] = static_cast<uint8_t>(text[i]);
    data[3 + 2 * i] = 0;
  }
  return static_cast<int>(length);
}

}  // namespace

UvcCamera::UvcCamera(CameraOptions options) : options_(std::move(options)) {
  frame_bytes_ = options_.width * options_.height * (options_.fourcc == "GREY" ? 1 : 2);
  frames_ = readFile(options_.frames_file);
  if (frames_.empty() || frames_.size() % frame_bytes_ != 0)
    throw std::runtime_error(options_.frames_file + ": " + std::to_string(frames_.size()) +
                             " bytes are no frames of " + std::to_string(frame_bytes_));
  for (const ControlSpec &control : kControls) controls_.push_back(control.def);
  buildConfiguration();
}

void UvcCamera::buildConfiguration() {
  std::vector<uint8_t> &out = configuration_;
  put(out, {9, 2, 0, 0, 2, 1, 0, 0x80, 250});    // configuration of two interfaces; its length is patched in below
  put(out, {8, 11, 0, 2, 0x0e, 0x03, 0x00, 0});  // which belong together
  put(out, {9, 4, kVideoControl, 0, 0, 0x0e, 0x01, 0x00, 2});
  const size_t control = out.size();
  put(out, {13, 0x24, 0x01, 0x00, 0x01, 0, 0});  // header, UVC 1.0
  put32(out, 1000000);                           // device clock, Hz
  put(out, {1, kVideoStreaming});
  put(out, {18, 0x24, 0x02, kCameraTerminal, 0x01, 0x02, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0x0a, 0, 0});
  put(out, {11, 0x24, 0x05, kProcessingUnit, kCameraTerminal, 0, 0, 2, 0x01, 0x02, 0});
  put(out, {9, 0x24, 0x03, 3, 0x01, 0x01, 0, kProcessingUnit, 0});  // output terminal
  patch16(out, control + 5, out.size() - control);

  put(out, {9, 4, kVideoStreaming, 0, 1, 0x0e, 0x02, 0x00, 0});
  const size_t streaming = out.size();
  put(out, {14, 0x24, 0x01, 1, 0, 0, 0x80 | kBulkEndpoint, 0, 3, 0, 0, 0, 1, 0});
  put(out, {27, 0x24, 0x04, 1, 1});  // uncompressed format
  for (int i = 0; i < 4; ++i) out.push_back(static_cast<uint8_t>(guidLetters(options_.fourcc)[i]));
  put(out, {0x00, 0x00, 0x10, 0x00, 0x80, 0x00, 0x00, 0xaa, 0x00, 0x38, 0x9b, 0x71});
  put(out, {options_.fourcc == "GREY" ? 8 : 16, 1, 0, 0, 0, 0});
  put(out, {30, 0x24, 0x05, 1, 0});  // its one frame size and rate
  put16(out, options_.width);
  put16(out, options_.height);
  put32(out, frame_bytes_ * 8 * options_.rate_hz);
  put32(out, frame_bytes_ * 8 * options_.rate_hz);
  put32(out, frame_bytes_);
  put32(out, 10000000 / options_.rate_hz);
  put(out, {1});
  put32(out, 10000000 / options_.rate_hz);
  put(out, {6, 0x24, 0x0d, 1, 1, 4});  // colour matching
  patch16(out, streaming + 4, out.size() - streaming);
  put(out, {7, 5, 0x80 | kBulkEndpoint, 2});
  put16(out, kBulkPacketBytes);
  put(out, {0});
  patch16(out, 2, out.size());
}

int UvcCamera::descriptor(uint8_t type, uint8_t index, uint8_t *data) const {
  if (type == 1) {
    const uint8_t device[] = {18,
                              1,
                              0x00,
                              0x02,
                              0xef,
                              2,
                              1,
                              64,
                              kVendorId & 0xff,
                              kVendorId >> 8,
                              kProductId & 0xff,
                              kProductId >> 8,
                              0x00,
                              0x01,
                              1,
                              2,
                              3,
                              1};
    std::memcpy(data, device, sizeof device);
    return sizeof device;
  }
  if (type == 2) {
    std::memcpy(data, configuration_.data(), configuration_.size());
    return static_cast<int>(configuration_.size());
  }
  if (type != 3) return -1;
  if (index == 0) {
    const uint8_t english[] = {4, 3, 0x09, 0x04};
    std::memcpy(data, english, sizeof english);
    return sizeof english;
  }
  return giveString(index == 1 ? "Virtual cameras" : index == 2 ? options_.name : "V0001", data);
}

int UvcCamera::standardRequest(const SetupPacket &setup, uint8_t *data) const {
  switch (setup.request) {
    case 0:  // get status
      data[0] = data[1] = 0;
      return 2;
    case 6:
      return descriptor(static_cast<uint8_t>(setup.value >> 8), static_cast<uint8_t>(setup.value), data);
    case 8:  // get configuration
      data[0] = 1;
      return 1;
    case 10:  // get interface
      data[0] = 0;
      return 1;
    case 1:
    case 3:
    case 5:
    case 9:
    case 11:
      return 0;  // clear and set feature, address, configuration, interface
    default:
      return -1;
  }
}

// What probe and commit agree on: there is nothing to choose.
std::array<uint8_t, 26> UvcCamera::streamParameters() const {
  std::array<uint8_t, 26> parameters{};
  parameters[2] = parameters[3] = 1;
  write32(&parameters[4], 10000000 / options_.rate_hz);
  write32(&parameters[18], frame_bytes_);
  write32(&parameters[22], kMostPayloadBytes);
  return parameters;
}

int UvcCamera::streamingRequest(const SetupPacket &setup, uint8_t *data) {
  constexpr uint8_t kCommit = 2;
  const std::array<uint8_t, 26> parameters = streamParameters();
  const int selector = setup.value >> 8;
  if (selector != 1 && selector != kCommit) return -1;
  switch (setup.request) {
    case kSetCur:
      if (selector == kCommit) next_frame_ = 0;  // a stream begins: from the first frame
      return 0;
    case kGetLen:
      data[0] = static_cast<uint8_t>(parameters.size());
      data[1] = 0;
      return 2;
    case kGetInfo:
      data[0] = 3;
      return 1;
    case kGetCur:
    case kGetMin:
    case kGetMax:
    case kGetDef:
      std::memcpy(data, parameters.data(), parameters.size());
      return static_cast<int>(parameters.size());
    default:
      return -1;
  }
}

int UvcCamera::cameraRequest(const SetupPacket &setup, uint8_t *data) {
  const int entity = setup.index >> 8, selector = setup.value >> 8;
  if (setup.request == kGetInfo) {
    data[0] = 3;
    return 1;
  }
  for (size_t i = 0; i < std::size(kControls); ++i) {
    const ControlSpec &control = kControls[i];
    if (control.entity != entity || control.selector != selector) continue;
    uint32_t value = 0;
    switch (setup.request) {
      case kSetCur:
        for (int byte = control.bytes; byte-- > 0;) value = value << 8 | data[byte];
        controls_[i] = value;
        return 0;
      case kGetCur:
        value = controls_[i];
        break;
      case kGetMin:
        value = control.min;
        break;
      case kGetMax:
        value = control.max;
        break;
      case kGetRes:
        value = i == kExposureMode ? options_.exposure_modes : control.step;
        break;
      case kGetDef:
        value = control.def;
        break;
      default:
        return -1;
    }
    uint8_t bytes[4];
    write32(bytes, value);
    std::memcpy(data, bytes, control.bytes);
    return control.bytes;
  }
  if (entity != 0 || selector != 0x02) return -1;
  data[0] = 0;  // why the last request was refused
  return 1;
}

int UvcCamera::control(const SetupPacket &setup, uint8_t *data) {
  constexpr uint8_t kTypeMask = 0x60, kStandard = 0x00, kClass = 0x20;
  if ((setup.request_type & kTypeMask) == kStandard) return standardRequest(setup, data);
  if ((setup.request_type & kTypeMask) != kClass) return -1;
  if ((setup.index & 0xff) == kVideoStreaming) return streamingRequest(setup, data);
  return cameraRequest(setup, data);
}

void UvcCamera::tick() {
  if (sending_) return;  // the host is slow; the frame waits
  if (options_.stall_after >= 0 && sent_ >= options_.stall_after) return;
  if (options_.unplug_after >= 0 && sent_ >= options_.unplug_after) {
    pulled_ = true;
    return;
  }
  const int64_t count = static_cast<int64_t>(frames_.size() / frame_bytes_);
  frame_ = frames_.data() + (next_frame_ % count) * frame_bytes_;
  offset_ = 0;
  end_ = next_frame_ == options_.cut_frame ? frame_bytes_ / 2 : frame_bytes_;
  frame_parity_ ^= 1;
  frame_time_us_ = clockUs();
  sending_ = true;
  ++next_frame_;
  ++sent_;
}

uint32_t UvcCamera::nextPayload(uint8_t *payload, uint32_t room_bytes) {
  constexpr uint8_t kHeaderBytes = 12, kEndOfFrame = 0x02, kHasTimes = 0x04 | 0x08, kEndOfHeader = 0x80;
  if (!sending_) return 0;
  if (room_bytes > kMostPayloadBytes) room_bytes = kMostPayloadBytes;
  if (room_bytes <= kHeaderBytes) return 0;
  const uint32_t bytes = std::min(end_ - offset_, room_bytes - kHeaderBytes);
  const bool is_last = offset_ + bytes == end_;
  const uint32_t now_us = clockUs();
  payload[0] = kHeaderBytes;
  payload[1] = static_cast<uint8_t>(kEndOfHeader | kHasTimes | frame_parity_ | (is_last ? kEndOfFrame : 0));
  write32(payload + 2, frame_time_us_);
  write32(payload + 6, now_us);
  payload[10] = static_cast<uint8_t>(now_us / 1000);  // number of the bus's frame, 1 ms each, 11 bits
  payload[11] = static_cast<uint8_t>(now_us / 1000 >> 8 & 7);
  std::memcpy(payload + kHeaderBytes, frame_ + offset_, bytes);
  offset_ += bytes;
  if (is_last) sending_ = false;
  return kHeaderBytes + bytes;
}

}  // namespace sphc::guest
