// A caller's function for pieces of work that has one thread, and takes the last piece first.
#pragma once
#include <cstdint>

#include "runtime/base/parallel.h"

namespace sphc::test {

inline void runBackwards(void *user, uint32_t count, Parallel::Task task, void *data) {
  if (user) ++*static_cast<uint32_t *>(user);  // how often it was called
  for (uint32_t i = count; i > 0; --i) task(data, i - 1);
}

inline Parallel backwards(uint32_t pieces, uint32_t *calls = nullptr) { return {runBackwards, calls, pieces}; }

}  // namespace sphc::test
