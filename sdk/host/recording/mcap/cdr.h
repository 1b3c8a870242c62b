// CDR, the encoding of ROS 2's messages: little-endian, each number at a multiple of its own size.
#pragma once

#include "bytes.h"

namespace sphc::recording {

class CdrWriter {
 public:
  // Appends; begins a message with the mark of little-endian CDR.
  explicit CdrWriter(Bytes &out) : out_(out) {
    append(out_, "\0\1\0\0", 4);
    start_ = out_.size();
  }

  template <typename Unsigned>
  void put(Unsigned value) {
    while ((out_.size() - start_) % sizeof value) out_.push_back(0);
    putLittle(out_, value);
  }
  void put(int32_t value) { put(static_cast<uint32_t>(value)); }
  void put(int64_t value) { put(static_cast<uint64_t>(value)); }
  void put(double value) {
    uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    put(bits);
  }
  void putText(std::string_view text) {
    put(static_cast<uint32_t>(text.size() + 1));
    append(out_, text.data(), text.size());
    out_.push_back(0);
  }
  // The length of a sequence of bytes, which the caller appends.
  void putLength(size_t size) { put(static_cast<uint32_t>(size)); }

 private:
  Bytes &out_;
  size_t start_;
};

class CdrReader {
 public:
  explicit CdrReader(ByteView message) : reader_(message) {
    const ByteView mark = reader_.take(4);
    little_ = mark.data && mark.data[0] == 0 && mark.data[1] == 1;
  }

  bool ok() const { return little_ && reader_.ok(); }

  template <typename Unsigned>
  Unsigned take() {
    const size_t behind = (reader_.position() - 4) % sizeof(Unsigned);
    if (behind) reader_.take(sizeof(Unsigned) - behind);
    return reader_.little<Unsigned>();
  }
  int32_t takeInt32() { return static_cast<int32_t>(take<uint32_t>()); }
  int64_t takeInt64() { return static_cast<int64_t>(take<uint64_t>()); }
  double takeDouble() {
    const uint64_t bits = take<uint64_t>();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }
  std::string_view takeText() {
    const std::string_view text = textOf(reader_.take(take<uint32_t>()));
    return text.substr(0, text.empty() ? 0 : text.size() - 1);  // without the zero at the end
  }
  ByteView takeBytes() { return reader_.take(take<uint32_t>()); }

 private:
  ByteReader reader_;
  bool little_;
};

}  // namespace sphc::recording
