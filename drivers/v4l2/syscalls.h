// The operating system as this driver sees it.  Tests put a device of their own behind it.
#pragma once

#include <cstddef>
#include <cstdint>

struct pollfd;

namespace sphc::v4l2 {

// Each as the call of its name: -1 (mmap: MAP_FAILED) and errno on failure.
struct Syscalls {
  void *self;
  int (*open)(void *self, const char *path, int flags);
  int (*close)(void *self, int fd);
  int (*ioctl)(void *self, int fd, unsigned long request, void *argument);
  void *(*mmap)(void *self, size_t bytes, int protection, int flags, int fd, int64_t offset);
  int (*munmap)(void *self, void *memory, size_t bytes);
  int (*poll)(void *self, pollfd *file, int64_t timeout_ns);
  int64_t (*nowNs)(void *self);  // CLOCK_MONOTONIC; cannot fail
};

extern const Syscalls kLinux;

}  // namespace sphc::v4l2
