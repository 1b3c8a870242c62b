// A list with room for `Capacity` elements inside itself.
#pragma once
#include <cstddef>

#include "runtime/base/assert.h"

namespace sphc {

template <typename T, size_t Capacity>
class FixedVector {
 public:
  void push(const T &value) {
    SPHC_ASSERT(size_ < Capacity);
    items_[size_++] = value;
  }
  void clear() { size_ = 0; }
  size_t size() const { return size_; }
  bool full() const { return size_ == Capacity; }
  const T *begin() const { return items_; }
  const T *end() const { return items_ + size_; }
  T &operator[](size_t i) {
    SPHC_ASSERT(i < size_);
    return items_[i];
  }
  const T &operator[](size_t i) const {
    SPHC_ASSERT(i < size_);
    return items_[i];
  }

 private:
  T items_[Capacity] = {};
  size_t size_ = 0;
};

}  // namespace sphc
