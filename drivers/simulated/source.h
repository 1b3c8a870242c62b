// source.h - the headset as a polled source with loans.
#pragma once

#include <memory>

#include "drivers/simulated/headset.h"
#include "spherecloud/spherecloud_capture.h"

namespace sphc::simulated {

class Source {
 public:
  explicit Source(const Headset &headset);
  void fill(sphc_source *source);

 private:
  static constexpr uint32_t kSlots = SPHC_SIMULATED_LOAN_LIMIT;

  struct Slot {
    std::unique_ptr<uint8_t[]> bytes;
    uint64_t token = 0;  // 0: not on loan
  };

  sphc_status start();
  sphc_status acquire(sphc_capture *capture);
  void release(const sphc_capture &capture);
  void stop();
  void render(Slot &slot, sphc_stream stream, uint32_t index, sphc_capture *capture);
  sphc_status fail(sphc_status status, const char *text);

  const Headset &headset_;
  Slot slots_[kSlots];
  bool running_ = false;
  uint64_t captures_ = 0;    // given since start
  uint64_t last_token_ = 0;  // never used twice, not even after a restart
  sphc_message message_{};
};

}  // namespace sphc::simulated
