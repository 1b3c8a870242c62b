// What a recorder's caller hands to its writing thread at once, in memory that is made before.
#pragma once
#include <array>
#include <vector>

#include "recording_encoder.h"

namespace sphc::recording {

// What was lost since the last capture that found a slot.
class DropList {
 public:
  void add(sphc_stream stream, DropCause cause, uint32_t first_sequence, uint32_t count, int64_t time_ns) {
    for (size_t i = 0; i < used_; ++i)
      if (drops_[i].stream == stream && drops_[i].cause == cause) {
        drops_[i].count += count;
        return;
      }
    drops_[used_++] = {stream, first_sequence, count, time_ns, cause};
  }
  void clear() { used_ = 0; }
  const Drop *begin() const { return drops_.data(); }
  const Drop *end() const { return drops_.data() + used_; }

 private:
  // Two streams and two causes; and what belongs to none, which no sequence counts.
  std::array<Drop, 5> drops_ = {};
  size_t used_ = 0;
};

// What was felt since the last slot; its memory is made at once.
constexpr size_t kMostWaiting = 256;
class Accelerations {
 public:
  Accelerations() { felt_.reserve(kMostWaiting); }
  bool isFull() const { return felt_.size() == kMostWaiting; }
  void add(const TimedAcceleration &acceleration) { felt_.push_back(acceleration); }
  void moveTo(Accelerations &other) {
    other.felt_.assign(felt_.begin(), felt_.end());
    felt_.clear();
  }
  auto begin() const { return felt_.begin(); }
  auto end() const { return felt_.end(); }

 private:
  std::vector<TimedAcceleration> felt_;
};

// What a stream gave so far.
struct StreamState {
  int64_t last_ns = -1;
  uint32_t last_sequence = 0;
  bool has_any() const { return last_ns >= 0; }
};

// An image, a pose, or room for what was felt.
struct Slot {
  enum class What { kImage, kPose, kAccelerations };  // these come with the others as well
  What what = What::kImage;
  CaptureNote note = {};  // of others than images, time and sequence
  sphc_image image = {}, amplitude = {};
  sphc_rigid pose = {};
  Accelerations accelerations;
  DropList drops;
  Bytes pixels;
};

}  // namespace sphc::recording
