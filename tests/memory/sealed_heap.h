// A heap that can be sealed: any allocation or release on this thread while it is sealed ends the program.
#pragma once
#include <cstddef>

namespace sphc::test {

class SealedHeap {
 public:
  SealedHeap();
  ~SealedHeap();
  SealedHeap(const SealedHeap &) = delete;
  SealedHeap &operator=(const SealedHeap &) = delete;
};

// Calls that the heap served since the program began: shows that it is this heap that is in use.
size_t heapCalls();

}  // namespace sphc::test
