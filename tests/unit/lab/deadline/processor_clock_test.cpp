#include "lab/deadline/processor_clock.h"

#include <gtest/gtest.h>
#include <time.h>

#include <chrono>
#include <thread>

namespace sphc::host {
namespace {

constexpr int64_t kMillisecondNs = 1000000;

int64_t threadNs() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return now.tv_sec * 1000000000ll + now.tv_nsec;
}

TEST(ProcessorClock, SleepDoesNotCount) {
  ProcessorClock clock;
  const int64_t before_ns = clock.now_ns(), before_thread_ns = threadNs();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const int64_t took_ns = clock.now_ns() - before_ns;
  EXPECT_GE(took_ns, 0);
  EXPECT_LE(took_ns, threadNs() - before_thread_ns + kMillisecondNs);
}

TEST(ProcessorClock, WorkCountsAndItNeverGoesBack) {
  ProcessorClock clock;
  const int64_t begin_ns = clock.now_ns(), begin_thread_ns = threadNs();
  int64_t last_ns = begin_ns;
  while (threadNs() - begin_thread_ns < 20 * kMillisecondNs) {
    const int64_t now_ns = clock.now_ns();
    ASSERT_GE(now_ns, last_ns);
    last_ns = now_ns;
  }
  EXPECT_GE(clock.now_ns() - begin_ns, 19 * kMillisecondNs);
}

}  // namespace
}  // namespace sphc::host
