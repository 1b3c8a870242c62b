// One piece of work on several threads.
#pragma once
#include <cstddef>
#include <future>
#include <system_error>
#include <vector>

namespace sphc::host {

// Calls work(0) to work(threads - 1) at once, or as many of the first as the system has threads for, and returns
// when all are over: what there is to do is theirs to share.  Throws what one of them threw.
template <typename Work>
void onThreads(size_t threads, const Work &work) {
  std::vector<std::future<void>> others;
  others.reserve(threads);
  try {
    for (size_t i = 1; i < threads; ++i) others.push_back(std::async(std::launch::async, [&work, i] { work(i); }));
  } catch (const std::system_error &) {  // those that run suffice
  }
  work(0);
  for (std::future<void> &other : others) other.get();
}

}  // namespace sphc::host
