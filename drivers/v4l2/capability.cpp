#include "capability.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace sphc::v4l2 {

namespace {

template <size_t kTo, size_t kFrom>
void copyText(char (&to)[kTo], const __u8 (&from)[kFrom]) {
  static_assert(kTo == kFrom, "the kernel's own size");
  std::memcpy(to, from, kTo);
  to[kTo - 1] = '\0';
}

}  // namespace

int readCapability(const Node &node, Capability *capability) {
  v4l2_capability reply = {};
  if (const int error = node.ioctl(VIDIOC_QUERYCAP, &reply)) return error;
  const uint32_t caps = reply.capabilities & V4L2_CAP_DEVICE_CAPS ? reply.device_caps : reply.capabilities;
  copyText(capability->card, reply.card);
  copyText(capability->bus, reply.bus_info);
  copyText(capability->driver, reply.driver);
  capability->is_multi_planar = (caps & V4L2_CAP_VIDEO_CAPTURE_MPLANE) != 0;
  capability->is_capture = (caps & V4L2_CAP_VIDEO_CAPTURE) != 0 || capability->is_multi_planar;
  capability->can_stream = (caps & V4L2_CAP_STREAMING) != 0;
  return 0;
}

bool OfferedFourccs::contains(uint32_t fourcc) const { return std::count(fourccs, fourccs + count, fourcc) != 0; }

int readOfferedFourccs(const Node &node, OfferedFourccs *offered) {
  offered->count = 0;
  while (offered->count < OfferedFourccs::kMax) {
    v4l2_fmtdesc description = {};
    description.index = offered->count;
    description.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    const int error = node.ioctl(VIDIOC_ENUM_FMT, &description);
    if (error == EINVAL) return 0;  // the end of the list
    if (error) return error;
    offered->fourccs[offered->count++] = description.pixelformat;
  }
  return 0;
}

}  // namespace sphc::v4l2
