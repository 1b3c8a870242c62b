// Plugs a UvcCamera into the kernel's virtual USB host (vhci_hcd), over the USB/IP protocol on a socket pair:
//
//     vhci_camera --port 0 --name color --format YUYV --size 640x480 --rate 10 --frames color.raw
#include <arpa/inet.h>
#include <fcntl.h>
#include <sys/socket.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>

#include "stream_io.h"
#include "transfer_queue.h"
#include "uvc_camera.h"

namespace sphc::guest {

namespace {

enum Command : uint32_t { kSubmit = 1, kUnlink = 2, kSubmitted = 3, kUnlinked = 4 };

// All big-endian; the commands give the last seven words different meanings.
struct Header {
  uint32_t command, sequence, device, direction, endpoint;
  uint32_t words[5];  // submit: flags, length, ...   submitted: status, length, ...   unlink: sequence
  uint8_t setup[8];
};
static_assert(sizeof(Header) == 48);

class VhciDevice {
 public:
  VhciDevice(UvcCamera &camera, int socket) : camera_(camera), socket_(socket) {}

  bool isWanted() const { return !wanted_.empty(); }

  void pump() {
    while (!wanted_.empty() && camera_.isSending()) {
      const uint32_t bytes = camera_.nextPayload(buffer_, wanted_.front().room_bytes);
      answer(kSubmitted, static_cast<uint32_t>(wanted_.front().id), 0, buffer_, bytes);
      wanted_.pop();
    }
  }

  bool serve() {
    Header header;
    if (!readAll(socket_, &header, sizeof header)) return false;
    const uint32_t sequence = ntohl(header.sequence);
    if (ntohl(header.command) == kUnlink) return unlink(sequence, ntohl(header.words[0]));
    if (ntohl(header.command) != kSubmit) return false;
    const uint32_t length = ntohl(header.words[1]);
    const bool towards_host = ntohl(header.direction) == 1;
    if (length > sizeof buffer_ || (!towards_host && !readAll(socket_, buffer_, length))) return false;
    if (ntohl(header.endpoint) == 0) return control(header.setup, sequence, towards_host, length);
    if (!towards_host || !wanted_.push({sequence, length})) return answer(kSubmitted, sequence, -EPIPE, nullptr, 0);
    pump();
    return true;
  }

 private:
  bool control(const uint8_t *setup, uint32_t sequence, bool towards_host, uint32_t length) {
    SetupPacket packet;
    std::memcpy(&packet, setup, sizeof packet);
    const int given = camera_.control(packet, buffer_);
    if (given < 0) return answer(kSubmitted, sequence, -EPIPE, nullptr, 0);
    if (!towards_host) return answer(kSubmitted, sequence, 0, nullptr, length);
    return answer(kSubmitted, sequence, 0, buffer_, std::min(static_cast<uint32_t>(given), length));
  }

  bool unlink(uint32_t sequence, uint32_t unlinked) {
    const bool was_waiting = wanted_.cancel(unlinked);
    if (was_waiting) camera_.abandonFrame();
    return answer(kUnlinked, sequence, was_waiting ? -ECONNRESET : 0, nullptr, 0);
  }

  bool answer(uint32_t command, uint32_t sequence, int status, const uint8_t *data, uint32_t length) {
    Header header{};
    header.command = htonl(command);
    header.sequence = htonl(sequence);
    header.words[0] = htonl(static_cast<uint32_t>(status));
    header.words[1] = htonl(command == kSubmitted ? length : 0);
    return writeAll(socket_, &header, sizeof header) && (!data || writeAll(socket_, data, length));
  }

  UvcCamera &camera_;
  int socket_;
  TransferQueue wanted_;
  uint8_t buffer_[1 << 16] = {};
};

// The kernel takes the other end of the socket pair.
int plugIn(const std::string &port) {
  constexpr const char *kAttach = "/sys/devices/platform/vhci_hcd.0/attach";
  constexpr int kHighSpeed = 3;
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0) return -1;
  const int attach = open(kAttach, O_WRONLY);
  char text[64];
  const int length = std::snprintf(text, sizeof text, "%s %d %d %d", port.c_str(), ends[1],
                                   0x10001 + std::atoi(port.c_str()), kHighSpeed);
  const bool attached = attach >= 0 && write(attach, text, static_cast<size_t>(length)) == length;
  if (!attached) std::perror(kAttach);
  close(attach);
  close(ends[1]);
  return attached ? ends[0] : -1;
}

}  // namespace

}  // namespace sphc::guest

int main(int argc, char **argv) try {
  using namespace sphc::guest;
  std::signal(SIGPIPE, SIG_IGN);
  const CameraOptions options = parseOptions(argc, argv, "--port");
  UvcCamera camera(options);
  const int socket = plugIn(options.where);
  if (socket < 0) return 1;
  VhciDevice device(camera, socket);
  servePeriodically(camera, device, socket);
  close(socket);  // the cable is out
  std::fprintf(stderr, "camera %s is unplugged\n", camera.name().c_str());
  return 0;
} catch (const std::exception &error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
