#include "syscalls.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

namespace sphc::v4l2 {

namespace {

constexpr int64_t kSecondNs = 1000000000;

int pollOne(void *, pollfd *file, int64_t timeout_ns) {
  const timespec timeout = {static_cast<time_t>(timeout_ns / kSecondNs), static_cast<long>(timeout_ns % kSecondNs)};
  return ppoll(file, 1, &timeout, nullptr);
}

int64_t monotonicNs(void *) {
  timespec now = {};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return int64_t{now.tv_sec} * kSecondNs + now.tv_nsec;
}

}  // namespace

const Syscalls kLinux = {
    nullptr,
    [](void *, const char *path, int flags) { return ::open(path, flags); },
    [](void *, int fd) { return ::close(fd); },
    [](void *, int fd, unsigned long request, void *argument) { return ::ioctl(fd, request, argument); },
    [](void *, size_t bytes, int protection, int flags, int fd, int64_t offset) {
      return ::mmap(nullptr, bytes, protection, flags, fd, static_cast<off_t>(offset));
    },
    [](void *, void *memory, size_t bytes) { return ::munmap(memory, bytes); },
    pollOne,
    monotonicNs};

}  // namespace sphc::v4l2
