// Serves a UvcCamera to an emulator from outside it, over the USB redirection protocol (usbredir 0.7) on a unix
// socket:
//
//     redirect_camera --socket PATH --name color --format YUYV --size 640x480 --rate 10 --frames color.raw
//
// with the emulator's -device qemu-xhci -chardev socket,id=c,path=PATH,server=on,wait=off -device
// usb-redir,chardev=c. Closing the socket pulls the cable; starting again plugs it in again.
#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>

#include "stream_io.h"
#include "transfer_queue.h"
#include "uvc_camera.h"

namespace sphc::guest {

namespace {

enum Message : uint32_t {
  kHello = 0,
  kDeviceConnect = 1,
  kReset = 3,
  kInterfaceInfo = 4,
  kEndpointInfo = 5,
  kSetConfiguration = 6,
  kGetConfiguration = 7,
  kConfigurationStatus = 8,
  kSetAltSetting = 9,
  kGetAltSetting = 10,
  kAltSettingStatus = 11,
  kCancel = 21,
  kControlPacket = 100,
  kBulkPacket = 101
};
enum Status : uint8_t { kSuccess = 0, kCancelled = 1, kStalled = 4 };

#pragma pack(push, 1)
struct FirstHeader {  // of hello, before both sides know that they speak with long ids
  uint32_t type, length, id;
};
struct Header {
  uint32_t type, length;
  uint64_t id;
};
struct Hello {
  char version[64];
  uint32_t capabilities;
};
struct DeviceConnect {
  uint8_t speed, device_class, device_subclass, device_protocol;
  uint16_t vendor, product, version;
};
struct InterfaceInfo {
  uint32_t count;
  uint8_t number[32], interface_class[32], interface_subclass[32], interface_protocol[32];
};
struct EndpointInfo {  // 0 to 15 towards the device, 16 to 31 towards the host
  uint8_t type[32], interval[32], interface[32];
  uint16_t packet_bytes[32];
};
struct Control {
  uint8_t endpoint, request, request_type, status;
  uint16_t value, index, length;
};
struct Bulk {
  uint8_t endpoint, status;
  uint16_t length_low;
  uint32_t stream;
  uint16_t length_high;
};
#pragma pack(pop)

// connect with version, endpoints' packet sizes, 64-bit ids, 32-bit bulk lengths
constexpr uint32_t kCapabilities = 1u << 1 | 1u << 4 | 1u << 5 | 1u << 6;

class RedirectedDevice {
 public:
  RedirectedDevice(UvcCamera &camera, int socket) : camera_(camera), socket_(socket) {}

  bool connect() {
    struct {
      FirstHeader header{kHello, sizeof(Hello), 0};
      Hello hello{"spherecloud test camera", kCapabilities};
    } ours;
    FirstHeader theirs{};
    if (!writeAll(socket_, &ours, sizeof(FirstHeader) + sizeof(Hello)) ||
        !readAll(socket_, &theirs, sizeof theirs) || theirs.type != kHello || theirs.length > sizeof body_ ||
        !readAll(socket_, body_, theirs.length))
      return false;
    constexpr uint8_t kHighSpeed = 2;
    const DeviceConnect device = {kHighSpeed, 0xef, 2, 1, kVendorId, kProductId, 0x0100};
    return describe() && send(kDeviceConnect, 0, device);
  }

  bool isWanted() const { return !wanted_.empty(); }

  void pump() {
    while (!wanted_.empty() && camera_.isSending()) {
      const uint32_t bytes = camera_.nextPayload(answer_, wanted_.front().room_bytes);
      sendBulk(wanted_.front().id, kSuccess, bytes);
      wanted_.pop();
    }
  }

  bool serve() {
    Header header;
    if (!readAll(socket_, &header, sizeof header) || header.length > sizeof body_ ||
        !readAll(socket_, body_, header.length))
      return false;
    switch (header.type) {
      case kSetConfiguration:
        return describe() && sendBytes(kConfigurationStatus, header.id, {kSuccess, body_[0]});
      case kGetConfiguration:
        return sendBytes(kConfigurationStatus, header.id, {kSuccess, 1});
      case kSetAltSetting:
        return describe() && sendBytes(kAltSettingStatus, header.id, {kSuccess, body_[0], body_[1]});
      case kGetAltSetting:
        return sendBytes(kAltSettingStatus, header.id, {kSuccess, body_[0], 0});
      case kCancel:
        return cancel(header.id);
      case kControlPacket:
        return control(header);
      case kBulkPacket:
        return bulk(header.id);
      default:
        return true;  // nothing that a camera would answer
    }
  }

 private:
  bool describe() {
    InterfaceInfo interfaces{};
    interfaces.count = 2;
    for (uint8_t i = 0; i < 2; ++i) {
      interfaces.number[i] = i;
      interfaces.interface_class[i] = 0x0e;
      interfaces.interface_subclass[i] = static_cast<uint8_t>(i + 1);
    }
    constexpr uint8_t kNone = 255, kBulkType = 2, kIn = 16;
    EndpointInfo endpoints{};
    std::memset(endpoints.type, kNone, sizeof endpoints.type);
    endpoints.type[0] = endpoints.type[kIn] = 0;
    endpoints.packet_bytes[0] = endpoints.packet_bytes[kIn] = 64;
    endpoints.type[kIn + kBulkEndpoint] = kBulkType;
    endpoints.interface[kIn + kBulkEndpoint] = 1;
    endpoints.packet_bytes[kIn + kBulkEndpoint] = kBulkPacketBytes;
    return send(kInterfaceInfo, 0, interfaces) && send(kEndpointInfo, 0, endpoints);
  }

  bool control(const Header &header) {
    Control packet;
    std::memcpy(&packet, body_, sizeof packet);
    const bool towards_host = packet.request_type & 0x80;
    if (!towards_host) std::memcpy(answer_, body_ + sizeof packet, header.length - sizeof packet);
    const int given =
        camera_.control({packet.request_type, packet.request, packet.value, packet.index, packet.length}, answer_);
    uint32_t bytes = 0;
    if (given < 0) {
      packet.status = kStalled;
      packet.length = 0;
    } else {
      packet.status = kSuccess;
      if (towards_host) {
        bytes = std::min<uint32_t>(static_cast<uint32_t>(given), packet.length);
        packet.length = static_cast<uint16_t>(bytes);
      }
    }
    return send(kControlPacket, header.id, packet, bytes);
  }

  bool bulk(uint64_t id) {
    Bulk packet;
    std::memcpy(&packet, body_, sizeof packet);
    const uint32_t room_bytes = packet.length_low | static_cast<uint32_t>(packet.length_high) << 16;
    if (!wanted_.push({id, room_bytes})) return sendBulk(id, kStalled, 0);
    pump();
    return true;
  }

  bool cancel(uint64_t id) {
    if (!wanted_.cancel(id)) return true;
    camera_.abandonFrame();
    return sendBulk(id, kCancelled, 0);
  }

  // With `bytes` of answer_ behind it.
  bool sendBulk(uint64_t id, Status status, uint32_t bytes) {
    const Bulk packet = {0x80 | kBulkEndpoint, status, static_cast<uint16_t>(bytes), 0,
                         static_cast<uint16_t>(bytes >> 16)};
    return send(kBulkPacket, id, packet, bytes);
  }

  template <typename Packet>
  bool send(uint32_t type, uint64_t id, const Packet &packet, uint32_t bytes = 0) {
    const Header header = {type, static_cast<uint32_t>(sizeof packet) + bytes, id};
    return writeAll(socket_, &header, sizeof header) && writeAll(socket_, &packet, sizeof packet) &&
           writeAll(socket_, answer_, bytes);
  }

  bool sendBytes(uint32_t type, uint64_t id, std::initializer_list<uint8_t> bytes) {
    const Header header = {type, static_cast<uint32_t>(bytes.size()), id};
    return writeAll(socket_, &header, sizeof header) && writeAll(socket_, bytes.begin(), bytes.size());
  }

  UvcCamera &camera_;
  int socket_;
  TransferQueue wanted_;
  uint8_t body_[1 << 17] = {}, answer_[1 << 17] = {};
};

// Waits up to 10 s for the emulator to be there.
int connectTo(const std::string &path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.copy(address.sun_path, sizeof address.sun_path - 1);
  const int file = socket(AF_UNIX, SOCK_STREAM, 0);
  for (int tries = 0; tries < 100; ++tries) {
    if (connect(file, reinterpret_cast<const sockaddr *>(&address), sizeof address) == 0) return file;
    usleep(100000);
  }
  std::perror(path.c_str());
  return -1;
}

}  // namespace

}  // namespace sphc::guest

int main(int argc, char **argv) try {
  using namespace sphc::guest;
  std::signal(SIGPIPE, SIG_IGN);
  const CameraOptions options = parseOptions(argc, argv, "--socket");
  UvcCamera camera(options);
  const int socket = connectTo(options.where);
  if (socket < 0) return 1;
  RedirectedDevice device(camera, socket);
  if (!device.connect()) return 1;
  servePeriodically(camera, device, socket);
  close(socket);  // the cable is out
  std::fprintf(stderr, "camera %s is unplugged\n", camera.name().c_str());
  return 0;
} catch (const std::exception &error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
