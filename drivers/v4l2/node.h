// An open device node.  Failures are errno values, 0 is success; explain() makes status and text of them.
#pragma once

#include <spherecloud/spherecloud.h>

#include "syscalls.h"

namespace sphc::v4l2 {

class Node {
 public:
  explicit Node(const Syscalls &syscalls) : syscalls_(syscalls) {}
  ~Node() { close(); }
  Node(const Node &) = delete;
  Node &operator=(const Node &) = delete;

  int open(const char *path);
  void close();

  // Interrupted calls are made again.
  int ioctl(unsigned long request, void *argument) const { return ioctlOf(fd_, request, argument); }
  int ioctlOf(int fd, unsigned long request, void *argument) const;  // of a file that came from this node

  int fd() const { return fd_; }
  const char *path() const { return path_; }
  const Syscalls &syscalls() const { return syscalls_; }
  int64_t nowNs() const { return syscalls_.nowNs(syscalls_.self); }

  // What failed, why, and what to do; ENODEV is DEVICE_LOST, everything else DEVICE.
  sphc_status explain(sphc_message *message, const char *call, int error) const;

 private:
  const Syscalls &syscalls_;
  int fd_ = -1;
  char path_[32] = "";  // its end, if it is long
};

// The end of a path that is too long for `room`.
const char *pathEnd(const char *path, size_t room);

}  // namespace sphc::v4l2
