// The caller's threads.  The library has none of its own: without the caller's function, pieces of work run one
// after another.
#pragma once
#include <cstddef>
#include <cstdint>

namespace sphc {

struct Parallel {
  using Task = void (*)(void *data, uint32_t index);

  static constexpr uint32_t kMostPieces = 8;

  void (*run)(void *user, uint32_t count, Task task, void *data) = nullptr;
  void *user = nullptr;
  uint32_t pieces = 1;  // that a stage's work is cut into at most

  // Calls piece(index) for every index below count, at most kMostPieces, at the same time as far as the caller's
  // function does; returns when all have ended.
  template <typename Piece>
  void forEach(uint32_t count, const Piece &piece) const {
    if (count > 1) {
      const auto call = [](void *data, uint32_t index) { (*static_cast<const Piece *>(data))(index); };
      run(user, count, call, const_cast<Piece *>(&piece));
    } else if (count == 1) {
      piece(0);
    }
  }
};

// Of things that are cut into pieces.
struct Part {
  size_t first, end;

  size_t size() const { return end - first; }
};
// The index-th of so many pieces of about the same size.
inline Part partOf(size_t size, uint32_t pieces, uint32_t index) {
  return {size * index / pieces, size * (index + 1) / pieces};
}

}  // namespace sphc
