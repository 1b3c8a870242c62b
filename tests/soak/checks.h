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

// What is counted over all frames.
struct Totals {
  uint64_t frames = 0, localized = 0, tracked = 0, elsewhere = 0;  // elsewhere: of the room that has no map
  uint64_t wrong_room = 0, wrong_pose = 0;  // given out; wrong: beyond 25 cm or 10 degrees, of unbroken frames
  uint64_t broken = 0, priors = 0, deadlines = 0, halves = 0;
  uint64_t refused_calls = 0, rooms = 0, unplugs = 0, swaps = 0, resets = 0, restarts = 0;
  uint64_t digest = 0xCBF29CE484222325u;  // of all results
};

// What is wrong with them, or null: too few frames have a pose, or a pose is wrong.
const char *faultOf(const Totals &totals);

// Of bytes, joined to those before (FNV-1a, 64 bits).
uint64_t digestOf(const void *bytes, size_t count, uint64_t before);

}  // namespace sphc::soak
