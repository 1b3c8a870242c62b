// Writes an explanation into a caller's sphc_message: no printf, which may allocate.
#pragma once
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "spherecloud/spherecloud.h"

namespace sphc {

// Appends text and numbers; what does not fit is cut off.  A null target swallows everything.
class MessageWriter {
 public:
  explicit MessageWriter(sphc_message *target) : target_(target) {
    if (target_) target_->text[0] = '\0';
  }
  MessageWriter &operator<<(const char *text);
  // Of any width: machines differ in what int, long and long long are.
  template <typename Integer, typename = std::enable_if_t<std::is_integral_v<Integer>>>
  MessageWriter &operator<<(Integer value) {
    if constexpr (std::is_signed_v<Integer>)
      return writeSigned(value);
    else
      return writeUnsigned(value);
  }
  // Six significant digits, plain from 1e-4 to 1e18, "1e-6" below; "nan", "inf".
  MessageWriter &operator<<(double value);

 private:
  void put(char c);
  MessageWriter &writeUnsigned(uint64_t value);
  MessageWriter &writeSigned(int64_t value);

  sphc_message *target_;
  size_t length_ = 0;
};

}  // namespace sphc
