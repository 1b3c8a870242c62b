// A lock, and waiting under it for a wake-up or a time of the monotonic clock.
#pragma once

#include <pthread.h>
#include <time.h>

#include <cstdint>

namespace sphc::openni2 {

inline int64_t monotonicNs() {
  timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return int64_t{now.tv_sec} * 1000000000 + now.tv_nsec;
}

// std::condition_variable waits by a call that the thread sanitizer of clang 14 does not know.
class Wakeup {
 public:
  Wakeup() {
    pthread_condattr_t attributes;
    pthread_condattr_init(&attributes);
    pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC);
    pthread_cond_init(&condition_, &attributes);
    pthread_condattr_destroy(&attributes);
  }
  ~Wakeup() {
    pthread_cond_destroy(&condition_);
    pthread_mutex_destroy(&mutex_);
  }
  Wakeup(const Wakeup &) = delete;
  Wakeup &operator=(const Wakeup &) = delete;

  void lock() { pthread_mutex_lock(&mutex_); }
  void unlock() { pthread_mutex_unlock(&mutex_); }
  void wake() { pthread_cond_broadcast(&condition_); }
  // Under the lock; both come back under it.
  void wait() { pthread_cond_wait(&condition_, &mutex_); }
  void waitUntil(int64_t time_ns) {
    timespec time = {};
    time.tv_sec = static_cast<time_t>(time_ns / 1000000000);
    time.tv_nsec = static_cast<long>(time_ns % 1000000000);
    pthread_cond_timedwait(&condition_, &mutex_, &time);
  }

 private:
  pthread_mutex_t mutex_ = PTHREAD_MUTEX_INITIALIZER;
  pthread_cond_t condition_;
};

}  // namespace sphc::openni2
