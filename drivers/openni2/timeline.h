// From the frame indices and timestamps of a device, which may be anything, to sequences and times that only grow.
#pragma once

#include "streams.h"

namespace sphc::openni2 {

// Where a frame stands among those of its stream.
struct Place {
  uint32_t sequence;
  int64_t time_ns;
  uint32_t lost;      // frames missing before this one
  bool duplicate;     // has been there: nothing else counts
  bool clock_jumped;  // the device's clock did; time_ns goes on where it was
};

class Timeline {
 public:
  // Recordings: each stream begins at time 0 however much later than the other it began; the order in the file
  // tells it to a frame period.
  void start(bool is_recording, const int64_t period_ns[kStreams]);

  // `arrival_ns`: of the host's monotonic clock; nothing in a recording.
  Place place(int stream, int frame_index, uint64_t timestamp_us, int64_t arrival_ns);

 private:
  struct State {
    bool begun;
    int frame_index;
    uint32_t sequence;
    int64_t device_ns, arrival_ns, time_ns;
    int64_t offset_ns;  // time_ns - device_ns
  };

  int64_t firstOffset(int64_t device_ns) const;
  bool clockJumped(const State &state, int64_t device_ns, int64_t arrival_ns) const;
  int64_t offsetAfterJump(int stream, int64_t device_ns, int64_t arrival_ns) const;

  bool is_recording_ = false;
  int64_t period_ns_[kStreams] = {};
  State states_[kStreams] = {};
  int64_t latest_ns_ = 0;  // time of any stream's frame
  int64_t offset_ns_ = 0;  // of the latest jump: the streams have one clock
};

}  // namespace sphc::openni2
