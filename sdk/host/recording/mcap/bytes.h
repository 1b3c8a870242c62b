// Little-endian bytes: appended to a buffer, and read with every bound checked.
#pragma once

#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>
#include <vector>

namespace sphc::recording {

using Bytes = std::vector<uint8_t>;

struct ByteView {
  const uint8_t *data = nullptr;
  size_t size = 0;
};
inline ByteView viewOf(const Bytes &bytes) { return {bytes.data(), bytes.size()}; }
inline std::string_view textOf(ByteView view) { return {reinterpret_cast<const char *>(view.data), view.size}; }

inline void append(Bytes &out, const void *data, size_t size) {
  const auto *bytes = static_cast<const uint8_t *>(data);
  out.insert(out.end(), bytes, bytes + size);
}

template <typename Unsigned>
void storeLittle(uint8_t *out, Unsigned value) {
  static_assert(std::is_unsigned_v<Unsigned>);
  for (size_t i = 0; i < sizeof value; ++i) out[i] = static_cast<uint8_t>(value >> (8 * i));
}

template <typename Unsigned>
Unsigned loadLittle(const uint8_t *data) {
  static_assert(std::is_unsigned_v<Unsigned>);
  Unsigned value = 0;
  for (size_t i = 0; i < sizeof value; ++i) value = static_cast<Unsigned>(value | Unsigned{data[i]} << (8 * i));
  return value;
}

template <typename Unsigned>
void putLittle(Bytes &out, Unsigned value) {
  uint8_t bytes[sizeof value];
  storeLittle(bytes, value);
  append(out, bytes, sizeof bytes);
}

// Reads on; beyond the end everything is zero and empty, and ok() is false from then on.
class ByteReader {
 public:
  explicit ByteReader(ByteView view) : view_(view) {}

  bool ok() const { return ok_; }
  size_t position() const { return position_; }
  size_t left() const { return view_.size - position_; }

  ByteView take(uint64_t size) {
    if (!ok_ || size > left()) {
      ok_ = false;
      return {};
    }
    const ByteView taken{view_.data + position_, static_cast<size_t>(size)};
    position_ += taken.size;
    return taken;
  }

  template <typename Unsigned>
  Unsigned little() {
    const ByteView bytes = take(sizeof(Unsigned));
    return bytes.data ? loadLittle<Unsigned>(bytes.data) : Unsigned{0};
  }

 private:
  ByteView view_;
  size_t position_ = 0;
  bool ok_ = true;
};

}  // namespace sphc::recording
