// Memory for what is laid out in an arena.
#pragma once
#include <cstdint>
#include <vector>

#include "runtime/base/arena.h"

namespace sphc::test {

// Where an arena may begin in memory of kArenaAlignment bytes more than it needs.
inline uint8_t *alignedStart(std::vector<uint8_t> *memory) {
  const auto address = reinterpret_cast<uintptr_t>(memory->data());
  return memory->data() + (kArenaAlignment - address % kArenaAlignment) % kArenaAlignment;
}

// Lays something out twice: to measure, then in memory of its own.  `layout(arena, has_memory)`.
class ArenaMemory {
 public:
  template <typename Layout>
  explicit ArenaMemory(const Layout &layout) {
    Arena measure;
    layout(measure, false);
    bytes_.resize(measure.used() + kArenaAlignment);
    Arena arena(alignedStart(&bytes_));
    layout(arena, true);
  }
  ArenaMemory(const ArenaMemory &) = delete;
  ArenaMemory &operator=(const ArenaMemory &) = delete;

 private:
  std::vector<uint8_t> bytes_;
};

}  // namespace sphc::test
