// What holds of every answer, whatever was asked.
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "spherecloud/spherecloud.h"

namespace sphc::soak {

// A caller's buffer with words around it that nobody may touch.
template <typename T>
class Guarded {
 public:
  T *get() { return &value_; }
  T *operator->() { return &value_; }
  const T &operator*() const { return value_; }
  bool isIntact() const {
    for (size_t i = 0; i < kWords; ++i)
      if (before_[i] != kWord || after_[i] != kWord) return false;
    return true;
  }

 private:
  static constexpr size_t kWords = 4;
  static constexpr uint64_t kWord = 0xC5D6E7F8091A2B3Cu;
  uint64_t before_[kWords] = {kWord, kWord, kWord, kWord};
  T value_ = {};
  uint64_t after_[kWords] = {kWord, kWord, kWord, kWord};
};

// What is wrong with the answer to a frame, or null.
const char *faultOf(sphc_status status, const sphc_localizer_frame &frame, const sphc_localizer_result &result);
const char *faultOf(sphc_status status, const sphc_localizer_prediction &prediction);
const char *faultOf(const sphc_localizer_hypothesis *hypotheses, uint32_t count);

// Of bytes, joined to those before (FNV-1a, 64 bits).
uint64_t digestOf(const void *bytes, size_t count, uint64_t before);

}  // namespace sphc::soak
