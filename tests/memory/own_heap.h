// Counts the heap calls that come from this program's own code, whatever the libraries beside it do.
#pragma once

#include <cstdint>

namespace sphc::test {

struct OwnHeap {
  int64_t calls;   // of any kind
  int64_t blocks;  // allocated and not freed
};
OwnHeap ownHeap();

}  // namespace sphc::test
