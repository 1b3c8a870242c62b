// How deep a call's stack goes: it runs on a thread whose stack was painted before.
#pragma once
#include <pthread.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <functional>

namespace sphc::host {

inline void *runOnPaintedStack(void *call) {
  (*static_cast<std::function<void()> *>(call))();
  return nullptr;
}

// Bytes, with those of the thread itself.  Symbols that are bound by the first call count too: call it once before.
inline size_t deepestOf(std::function<void()> call) {
  constexpr size_t kStackBytes = 1 << 20;
  constexpr uint8_t kPaint = 0xD7;
  uint8_t *stack = static_cast<uint8_t *>(std::aligned_alloc(4096, kStackBytes));
  std::memset(stack, kPaint, kStackBytes);
  pthread_attr_t attributes;
  pthread_t thread;
  pthread_attr_init(&attributes);
  if (pthread_attr_setstack(&attributes, stack, kStackBytes) ||
      pthread_create(&thread, &attributes, runOnPaintedStack, &call))
    std::abort();
  pthread_join(thread, nullptr);
  const uint8_t *touched = std::find_if(stack, stack + kStackBytes, [](uint8_t b) { return b != kPaint; });
  const size_t deepest = static_cast<size_t>(stack + kStackBytes - touched);
  std::free(stack);
  return deepest;
}

}  // namespace sphc::host
