// Memory for what is laid out in an arena.
#pragma once
#include <vector>

#include "runtime/base/arena.h"

namespace sphc::test {

// Lays something out twice: to measure, then in memory of its own.  `layout(arena, has_memory)`.
class ArenaMemory {
 public:
  template <typename Layout>
  explicit ArenaMemory(const Layout &layout) {
    Arena measure;
    layout(measure, false);
    bytes_.resize(measure.used() + kArenaAlignment);
    uint8_t *start = bytes_.data();
    while (reinterpret_cast<uintptr_t>(start) % kArenaAlignment) ++start;
    Arena arena(start);
    layout(arena, true);
  }
  ArenaMemory(const ArenaMemory &) = delete;
  ArenaMemory &operator=(const ArenaMemory &) = delete;

 private:
  std::vector<uint8_t> bytes_;
};

}  // namespace sphc::test
