// The two encodings of ROS's messages: CDR of ROS 2, and ROS 1's own, which neither pads nor ends texts by a zero.
#pragma once

#include "host/recording/mcap/cdr.h"

namespace sphc::recording {

enum class RosEncoding { kOther, kRos1, kCdr };

struct RosMessage {
  ByteView bytes;
  RosEncoding encoding;
};

class RosReader {
 public:
  explicit RosReader(const RosMessage &message)
      : cdr_(message.bytes), ros1_(message.bytes), is_cdr_(message.encoding == RosEncoding::kCdr) {}

  bool isRos1() const { return !is_cdr_; }
  bool ok() const { return is_cdr_ ? cdr_.ok() : ros1_.ok(); }

  template <typename Unsigned>
  Unsigned take() {
    return is_cdr_ ? cdr_.take<Unsigned>() : ros1_.little<Unsigned>();
  }
  float takeFloat() { return numberOf<float>(take<uint32_t>()); }
  double takeDouble() { return numberOf<double>(take<uint64_t>()); }
  ByteView takeBytes() { return is_cdr_ ? cdr_.takeBytes() : ros1_.take(ros1_.little<uint32_t>()); }
  std::string_view takeText() { return is_cdr_ ? cdr_.takeText() : textOf(takeBytes()); }

 private:
  template <typename Number, typename Unsigned>
  static Number numberOf(Unsigned bits) {
    static_assert(sizeof(Number) == sizeof bits);
    Number value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }

  CdrReader cdr_;
  ByteReader ros1_;
  bool is_cdr_;
};

}  // namespace sphc::recording
