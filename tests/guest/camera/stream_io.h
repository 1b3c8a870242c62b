// Whole reads and writes on a socket, and a timer to wait for beside it.
#pragma once

#include <poll.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>

namespace sphc::guest {

inline bool readAll(int file, void *data, size_t bytes) {
  for (char *at = static_cast<char *>(data); bytes > 0;) {
    const ssize_t got = read(file, at, bytes);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    at += got;
    bytes -= static_cast<size_t>(got);
  }
  return true;
}

inline bool writeAll(int file, const void *data, size_t bytes) {
  for (const char *at = static_cast<const char *>(data); bytes > 0;) {
    const ssize_t put = write(file, at, bytes);
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0) return false;
    at += put;
    bytes -= static_cast<size_t>(put);
  }
  return true;
}

inline int periodicTimer(uint32_t rate_hz) {
  const int timer = timerfd_create(CLOCK_MONOTONIC, 0);
  itimerspec period{};
  period.it_interval.tv_nsec = period.it_value.tv_nsec = 1000000000 / rate_hz - (rate_hz == 1);
  timerfd_settime(timer, 0, &period, nullptr);
  return timer;
}

// Serves `device` until the cable is pulled or the host is gone: Device::serve() answers one message of the host
// and is false when there will be no more; Device::pump() sends what can be sent.
template <typename Camera, typename Device>
void servePeriodically(Camera &camera, Device &device, int socket) {
  const int timer = periodicTimer(camera.rateHz());
  while (!camera.cableIsPulled()) {
    pollfd files[2] = {{socket, POLLIN, 0}, {timer, POLLIN, 0}};
    if (poll(files, 2, -1) < 0) continue;
    uint64_t ticks = 0;
    if (files[1].revents && read(timer, &ticks, sizeof ticks) == sizeof ticks && device.isWanted()) {
      camera.tick();
      device.pump();
    }
    if (files[0].revents && !device.serve()) break;
  }
  close(timer);
}

}  // namespace sphc::guest
