// Sorting without comparisons, which branch predictors cannot foretell.
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

namespace sphc {

struct SortKey {
  uint32_t key, index;
};

// Orders as the value does, for values >= 0; the complement orders the other way round.
inline uint32_t keyOf(float value) {
  uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

// By key, smallest first; equal keys stay in order.  `spare` has room for `count`.
inline void radixSort(SortKey *values, SortKey *spare, size_t count) {
  uint32_t begin[4][256] = {};
  for (size_t i = 0; i < count; ++i) {
    for (int32_t pass = 0; pass < 4; ++pass) ++begin[pass][values[i].key >> (8 * pass) & 255];
  }
  for (int32_t pass = 0; pass < 4; ++pass) {
    uint32_t sum = 0;
    for (uint32_t &entry : begin[pass]) sum += std::exchange(entry, sum);
    for (size_t i = 0; i < count; ++i) spare[begin[pass][values[i].key >> (8 * pass) & 255]++] = values[i];
    std::swap(values, spare);  // after four passes the result lies where it began
  }
}

}  // namespace sphc
