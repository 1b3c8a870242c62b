// A pointer and a length; borrows.
#pragma once
#include <cstddef>
#include <type_traits>

#include "runtime/base/assert.h"

namespace sphc {

template <typename T>
class Span {
 public:
  constexpr Span() = default;
  constexpr Span(T *data, size_t size) : data_(data), size_(size) {}
  template <typename U, typename = std::enable_if_t<std::is_same_v<const U, T>>>
  constexpr Span(Span<U> other) : data_(other.data()), size_(other.size()) {}

  constexpr T *data() const { return data_; }
  constexpr size_t size() const { return size_; }
  constexpr bool empty() const { return size_ == 0; }
  constexpr T *begin() const { return data_; }
  constexpr T *end() const { return data_ + size_; }
  T &operator[](size_t i) const {
    SPHC_ASSERT(i < size_);
    return data_[i];
  }
  constexpr Span first(size_t n) const { return Span(data_, n); }

 private:
  T *data_ = nullptr;
  size_t size_ = 0;
};

}  // namespace sphc
