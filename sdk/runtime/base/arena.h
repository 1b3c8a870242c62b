// One layout walk for both questions: "how many bytes?" and "where does each array lie?".
//
// A module describes its memory once, in a function that takes an Arena.  Run over an arena without memory it only
// adds up; run over one with memory it hands out the arrays.  The two cannot disagree, because they are the same
// walk.
#pragma once
#include <cstddef>
#include <cstdint>

#include "runtime/base/span.h"

namespace sphc {

constexpr size_t kArenaAlignment = 64;  // a cache line, and enough for 512-bit vectors

class Arena {
 public:
  // Told of every array taken: its name and bytes, padding included.
  using Visitor = void (*)(void *user, const char *name, size_t bytes);

  // Measures only.
  explicit Arena(Visitor visit = nullptr, void *user = nullptr) : visit_(visit), user_(user) {}
  // Hands out pieces of `memory`, which is aligned to kArenaAlignment and as large as a measuring walk said.
  explicit Arena(void *memory) : memory_(static_cast<unsigned char *>(memory)) {}

  // `name` is static storage: "features.pyramid".
  template <typename T>
  Span<T> take(const char *name, size_t count) {
    static_assert(alignof(T) <= kArenaAlignment);
    void *data = takeBytes(name, count * sizeof(T));
    return Span<T>(static_cast<T *>(data), data ? count : 0);
  }

  bool measuring() const { return memory_ == nullptr; }
  size_t used() const { return used_; }

 private:
  // Null while measuring.
  void *takeBytes(const char *name, size_t bytes);

  unsigned char *memory_ = nullptr;
  size_t used_ = 0;
  Visitor visit_ = nullptr;
  void *user_ = nullptr;
};

}  // namespace sphc
