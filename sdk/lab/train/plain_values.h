// Plain values in files that numpy reads and writes too.
#pragma once
#include <istream>
#include <ostream>
#include <type_traits>

namespace sphc::host {

template <typename T>
void writePlain(const T &value, std::ostream *out) {
  static_assert(std::is_trivially_copyable_v<T>, "bytes as they lie in memory");
  out->write(reinterpret_cast<const char *>(&value), sizeof value);
}

template <typename T>
T readPlain(std::istream *in) {
  static_assert(std::is_trivially_copyable_v<T>, "bytes as they lie in memory");
  T value = {};
  in->read(reinterpret_cast<char *>(&value), sizeof value);
  return value;
}

}  // namespace sphc::host
