#include "host/frames/heap_arena.h"

namespace sphc::host {

Arena heapFor(const Arena &size, std::vector<uint8_t> *memory) {
  memory->resize(size.used() + kArenaAlignment);
  const auto address = reinterpret_cast<uintptr_t>(memory->data());
  return Arena(memory->data() + (kArenaAlignment - address % kArenaAlignment) % kArenaAlignment);
}

}  // namespace sphc::host
