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
    start(
        count, [](void *data, uint32_t index) { (*static_cast<const Piece *>(data))(index); },
        const_cast<Piece *>(&piece));
  }
  // The same of pieces that say whether they were done; were all?
  template <typename Piece>
  bool allOf(uint32_t count, const Piece &piece) const {
    return startAll(
        count, [](void *data, uint32_t index) { return (*static_cast<const Piece *>(data))(index); },
        const_cast<Piece *>(&piece));
  }
  // The two at the same time, or one after the other.
  template <typename First, typename Second>
  void both(const First &first, const Second &second) const {
    if (pieces > 1) return forEach(2, [&](uint32_t i) { i == 0 ? first() : second(); });
    first();
    second();
  }

 private:
  void start(uint32_t count, Task task, void *data) const;
  bool startAll(uint32_t count, bool (*task)(void *data, uint32_t index), void *data) const;
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
