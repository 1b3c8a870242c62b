#include "drivers/simulated/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace sphc::simulated {

void parallelFor(uint32_t count, uint32_t threads, const std::function<void(uint32_t)> &body) {
  if (threads == 0) threads = std::clamp(std::thread::hardware_concurrency(), 1u, 64u);
  std::atomic<uint32_t> next{0};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto work = [&] {
    try {
      for (uint32_t i = next++; i < count; i = next++) body(i);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(failure_mutex);
      if (!failure) failure = std::current_exception();
      next = count;
    }
  };
  std::vector<std::thread> helpers;
  helpers.reserve(threads);
  try {
    while (helpers.size() + 1 < std::min(threads, count)) helpers.emplace_back(work);
  } catch (const std::system_error &) {
    // No more threads to be had: those that run suffice.
  }
  work();
  for (std::thread &helper : helpers) helper.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace sphc::simulated
