#include "timeline.h"

#include <algorithm>

namespace sphc::openni2 {

namespace {

constexpr int64_t kJumpNs = 1000000000;           // the device's clock may gain less on the host's in a frame
constexpr int64_t kRecordedJumpNs = 60000000000;  // a recording has no other clock to compare with
constexpr uint64_t kMaxTimestampUs = 1ull << 52;  // 142 years: in nanoseconds it still leaves room for offsets
constexpr int kMaxGap = 1000000;                  // a wider one is a counter that began anew

bool counterGoesOn(int before, int now) { return now > before && int64_t{now} - before <= kMaxGap; }

}  // namespace

void Timeline::start(bool is_recording, const int64_t period_ns[kStreams]) {
  *this = {};
  is_recording_ = is_recording;
  std::copy(period_ns, period_ns + kStreams, period_ns_);
}

Place Timeline::place(int stream, int frame_index, uint64_t timestamp_us, int64_t arrival_ns) {
  State &state = states_[stream];
  const int64_t device_ns = 1000 * static_cast<int64_t>(std::min(timestamp_us, kMaxTimestampUs));
  Place place = {};
  if (!state.begun) {
    state.offset_ns = firstOffset(device_ns);
    state.sequence = static_cast<uint32_t>(frame_index);
    state.begun = true;
  } else {
    if (frame_index == state.frame_index) {
      place.duplicate = true;
      return place;
    }
    const bool goes_on = counterGoesOn(state.frame_index, frame_index);
    const uint32_t step = goes_on ? static_cast<uint32_t>(frame_index - state.frame_index) : 1;
    place.lost = step - 1;
    state.sequence += step;
    place.clock_jumped = clockJumped(state, device_ns, arrival_ns);
    if (place.clock_jumped) state.offset_ns = offset_ns_ = offsetAfterJump(stream, device_ns, arrival_ns);
  }
  state.frame_index = frame_index;
  state.device_ns = device_ns;
  state.arrival_ns = arrival_ns;
  state.time_ns = device_ns + state.offset_ns;
  latest_ns_ = std::max(latest_ns_, state.time_ns);
  place.sequence = state.sequence;
  place.time_ns = state.time_ns;
  return place;
}

int64_t Timeline::firstOffset(int64_t device_ns) const {
  return is_recording_ ? latest_ns_ - device_ns : offset_ns_;
}

bool Timeline::clockJumped(const State &state, int64_t device_ns, int64_t arrival_ns) const {
  const int64_t step_ns = device_ns - state.device_ns;
  return step_ns <= 0 || step_ns > (is_recording_ ? kRecordedJumpNs : arrival_ns - state.arrival_ns + kJumpNs);
}

// The other stream's, if it jumped before and that fits; else so that time goes on as the host's clock did.
int64_t Timeline::offsetAfterJump(int stream, int64_t device_ns, int64_t arrival_ns) const {
  const State &state = states_[stream];
  const int64_t step_ns =
      is_recording_ ? period_ns_[stream] : std::max(arrival_ns - state.arrival_ns, int64_t{1000});
  const int64_t shared_ns = device_ns + offset_ns_;
  const bool shared_fits = shared_ns > state.time_ns && shared_ns - (state.time_ns + step_ns) < kJumpNs;
  return shared_fits ? offset_ns_ : state.time_ns + step_ns - device_ns;
}

}  // namespace sphc::openni2
