// The recording as a source: captures in order of time, on loan.
#pragma once

#include <chrono>
#include <vector>

#include "host/recording/image_reader.h"
#include "replay.h"
#include "spherecloud/spherecloud_capture.h"

namespace sphc::replay {

using recording::ImageReader;
using recording::RecordedImage;
using recording::Recording;

class Player {
 public:
  // Borrows the recording.
  Player(const Recording &recording, const sphc_rig &calibration, const sphc_replay_config &config);

  sphc_status start();
  sphc_status acquire(uint32_t timeout_us, sphc_capture &capture);
  void release(const sphc_capture &capture);
  void stop();

  sphc_source source();
  const char *message() const { return message_.text; }
  sphc_message *messageRoom() { return &message_; }

 private:
  using Clock = std::chrono::steady_clock;
  struct Event {
    int64_t time_ns;
    sphc_stream stream;
    uint32_t index;  // in the stream's list
  };
  struct Slot {
    std::vector<uint8_t> pixels;
    uint64_t token;  // of its loan; 0 when free
  };

  void addEvents(sphc_stream stream, const std::vector<RecordedImage> &images);
  Slot *freeSlot();
  bool waitUntilDue(int64_t time_ns, uint32_t timeout_us) const;

  const Recording &recording_;
  ImageReader reader_;
  sphc_replay_mode mode_;
  std::vector<Event> events_;
  std::vector<Slot> slots_;
  size_t slot_bytes_;
  bool running_ = false;
  size_t next_event_ = 0;
  uint64_t last_token_ = 0;  // counts through restarts, so that an old loan is never taken for a new one
  Clock::time_point started_;
  sphc_message message_ = {};
};

}  // namespace sphc::replay
