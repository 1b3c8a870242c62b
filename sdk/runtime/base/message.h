// Writes an explanation into a caller's sphc_message: no printf, which may allocate.
#pragma once
#include <cstddef>
#include <cstdint>

#include "spherecloud/spherecloud.h"

namespace sphc {

// Appends text and numbers; what does not fit is cut off.  A null target swallows everything.
class MessageWriter {
 public:
  explicit MessageWriter(sphc_message *target) : target_(target) {
    if (target_) target_->text[0] = '\0';
  }
  MessageWriter &operator<<(const char *text);
  MessageWriter &operator<<(uint64_t value);
  MessageWriter &operator<<(int64_t value);
  MessageWriter &operator<<(uint32_t value) { return *this << static_cast<uint64_t>(value); }
  MessageWriter &operator<<(int32_t value) { return *this << static_cast<int64_t>(value); }
  // Six significant digits, plain notation; "nan", "inf".
  MessageWriter &operator<<(double value);

 private:
  void put(char c);

  sphc_message *target_;
  size_t length_ = 0;
};

}  // namespace sphc
