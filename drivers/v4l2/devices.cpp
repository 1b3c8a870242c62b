#include "devices.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iterator>

#include "capability.h"
#include "drivers/pixels/explain.h"
#include "pixel_format.h"

namespace sphc::v4l2 {

namespace {

constexpr uint32_t kMaxNodes = 256;  // that Linux can have
constexpr char kCard[] = "card=", kBus[] = "bus=";

bool startsWith(const char *text, const char *start) { return std::strncmp(text, start, std::strlen(start)) == 0; }

template <size_t kTo, size_t kFrom>
void copyText(char (&to)[kTo], const char (&from)[kFrom]) {
  static_assert(kTo == kFrom, "the same text");
  std::memcpy(to, from, kTo);
}

void setProblem(sphc_v4l2_device *device, const char *what, int error) {
  std::snprintf(device->problem, sizeof device->problem, "%s: %s%s", what, std::strerror(error),
                error == EACCES ? "; add the user to the node's group, mostly `video`" : "");
}

void describeFormats(const Node &node, sphc_v4l2_device *device) {
  OfferedFourccs offered;
  if (const int error = readOfferedFourccs(node, &offered)) return setProblem(device, "VIDIOC_ENUM_FMT", error);
  device->fourcc_count = std::min(offered.count, static_cast<uint32_t>(std::size(device->fourccs)));
  std::copy(offered.fourccs, offered.fourccs + device->fourcc_count, device->fourccs);
  for (uint32_t i = 0; i < offered.count; ++i) {
    const PixelFormat *format = findPixelFormat(offered.fourccs[i]);
    if (!format) continue;
    (format->stream == SPHC_STREAM_COLOR ? device->can_color : device->can_depth) = 1;
  }
}

// False when there is no such node, or it does not capture video.
bool describeNode(const Syscalls &syscalls, uint32_t number, sphc_v4l2_device *device) {
  *device = {};
  std::snprintf(device->node, sizeof device->node, "/dev/video%u", number);
  Node node(syscalls);
  if (const int error = node.open(device->node)) {
    setProblem(device, "open", error);
    return error != ENOENT && error != ENXIO && error != ENODEV;
  }
  Capability capability;
  if (const int error = readCapability(node, &capability)) {
    setProblem(device, "VIDIOC_QUERYCAP", error);
    return error != ENODEV;
  }
  copyText(device->card, capability.card);
  copyText(device->bus, capability.bus);
  copyText(device->driver, capability.driver);
  if (!capability.is_capture) return false;
  if (capability.is_multi_planar)
    std::snprintf(device->problem, sizeof device->problem, "multi-planar, which this driver cannot; use libcamera");
  else if (!capability.can_stream)
    std::snprintf(device->problem, sizeof device->problem, "cannot stream, only read(); not supported");
  else
    describeFormats(node, device);
  return true;
}

template <typename Visit>
void forEachDevice(const Syscalls &syscalls, Visit visit) {
  for (uint32_t number = 0; number < kMaxNodes; ++number) {
    sphc_v4l2_device device;
    if (describeNode(syscalls, number, &device) && visit(device)) return;
  }
}

}  // namespace

void listDevices(const Syscalls &syscalls, sphc_v4l2_device *devices, uint32_t capacity, uint32_t *count) {
  uint32_t found = 0;
  forEachDevice(syscalls, [&](const sphc_v4l2_device &device) {
    if (found < capacity) devices[found] = device;
    ++found;
    return false;
  });
  *count = found;
}

bool isNamedByProperty(const char *camera) { return startsWith(camera, kCard) || startsWith(camera, kBus); }

sphc_status findNode(const Syscalls &syscalls, const char *camera, sphc_stream stream, NodePath *path,
                     sphc_message *message) {
  const bool by_card = startsWith(camera, kCard);
  const char *wanted = camera + std::strlen(by_card ? kCard : kBus);
  bool found = false;
  sphc_v4l2_device closed = {};  // that it may be, but for its problem
  forEachDevice(syscalls, [&](const sphc_v4l2_device &device) {
    const bool is_named = std::strcmp(by_card ? device.card : device.bus, wanted) == 0;
    if (device.problem[0] && (is_named || !device.card[0]) && !closed.problem[0]) closed = device;
    found = is_named && !device.problem[0] && (stream == SPHC_STREAM_DEPTH ? device.can_depth : device.can_color);
    if (found) std::snprintf(path->text, sizeof path->text, "%s", device.node);
    return found;
  });
  if (found) return SPHC_OK;
  const char *wish = stream == SPHC_STREAM_DEPTH ? "depth" : "colour";
  if (closed.problem[0])
    return pixels::explain(message, SPHC_E_DEVICE,
                           "no camera %.64s with a %s stream; is it plugged in? It may be %s (%s)", camera, wish,
                           closed.node, closed.problem);
  return pixels::explain(
      message, SPHC_E_DEVICE,
      "no camera %.64s with a %s stream; is it plugged in? `spherecloud devices` lists what is there", camera,
      wish);
}

}  // namespace sphc::v4l2
