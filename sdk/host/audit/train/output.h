// Plain values to a file that numpy reads.
#pragma once
#include <ostream>
#include <type_traits>

namespace sphc::host {

template <typename T>
void writeValue(const T &value, std::ostream *out) {
  static_assert(std::is_trivially_copyable_v<T>, "bytes as they lie in memory");
  out->write(reinterpret_cast<const char *>(&value), sizeof value);
}

}  // namespace sphc::host
