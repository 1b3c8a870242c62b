#include "node.h"

#include <fcntl.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "drivers/pixels/explain.h"

namespace sphc::v4l2 {

namespace {

constexpr int kMaxTries = 100;  // of a call that signals interrupt

const char *cure(int error) {
  switch (error) {
    case ENOENT:
    case ENXIO:
      return "is the camera plugged in? `spherecloud devices` lists what is there";
    case ENODEV:
      return "the camera was unplugged; stop, close, and open it again once it is back, by bus= or card=: its node "
             "may have another number";
    case EACCES:
    case EPERM:
      return "no permission; add the user to the group that owns the node, mostly `video`";
    case EBUSY:
      return "another program or handle has it; close that first";
    case ENOSPC:
      return "too little USB bandwidth; ask for a smaller size, fewer frames or MJPG, or use another port";
    case ENOMEM:
      return "out of memory for buffers; ask for fewer or smaller ones";
    case EMFILE:
    case ENFILE:
      return "too many open files; close some";
    case ENOTTY:
      return "no video device, or its driver cannot do this; give another node";
    case EIO:
      return "the camera does not answer properly; plug it in again if it stays so";
    default:
      return "the kernel's log (dmesg) may say more";
  }
}

}  // namespace

const char *pathEnd(const char *path, size_t room) {
  const size_t length = std::strlen(path);
  return length < room ? path : path + length - (room - 1);
}

int Node::open(const char *path) {
  std::snprintf(path_, sizeof path_, "%s", pathEnd(path, sizeof path_));
  for (int tries = 0; tries < kMaxTries; ++tries) {
    fd_ = syscalls_.open(syscalls_.self, path, O_RDWR | O_NONBLOCK | O_CLOEXEC);
    if (fd_ >= 0) return 0;
    if (errno != EINTR) break;
  }
  return errno;
}

void Node::close() {
  if (fd_ >= 0) syscalls_.close(syscalls_.self, fd_);
  fd_ = -1;
}

int Node::ioctlOf(int fd, unsigned long request, void *argument) const {
  for (int tries = 0; tries < kMaxTries; ++tries) {
    if (syscalls_.ioctl(syscalls_.self, fd, request, argument) >= 0) return 0;
    if (errno != EINTR) break;
  }
  return errno;
}

sphc_status Node::explain(sphc_message *message, const char *call, int error) const {
  return pixels::explain(message, error == ENODEV ? SPHC_E_DEVICE_LOST : SPHC_E_DEVICE, "%s: %s: %s (errno %d): %s",
                         path_, call, std::strerror(error), error, cure(error));
}

}  // namespace sphc::v4l2
