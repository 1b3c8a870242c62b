// Pairs two streams by time.  Holds loans, never images; knows no device.
#pragma once
#include "spherecloud/spherecloud_capture.h"

namespace sphc {

class Pairer {
 public:
  explicit Pairer(const sphc_pairer_config &config) : config_(config) {}

  sphc_status push(const sphc_capture &capture);
  sphc_status pop(sphc_capture *color_capture, sphc_capture *depth_capture, sphc_capture *dropped);
  void flush() { ended_ = true; }
  const sphc_pairer_counts &counts() const { return counts_; }

 private:
  // Captures of one stream in order of time.
  struct Queue {
    sphc_capture slots[SPHC_PAIRER_SLOTS] = {};
    uint32_t count = 0;
    bool begun = false;
    uint32_t last_sequence = 0;
    int64_t last_ns = 0, last_middle_ns = 0;
    uint64_t gap_ns = 0;  // between the last two, a sequence number; 0: unknown

    uint32_t stepsTo(const sphc_capture &capture) const;
    void add(const sphc_capture &capture);
    sphc_capture takeFront();
    bool nextMayBeNearer(const sphc_capture &other) const;
  };
  bool isWithinTolerance(const sphc_capture &color, const sphc_capture &depth) const;
  bool isColorOvertaken() const;
  bool canStillImprove() const;
  sphc_status drop(Queue *queue, sphc_pairer_drop why, sphc_capture *dropped);

  sphc_pairer_config config_;
  Queue color_, depth_;
  bool ended_ = false;
  bool begun_ = false;
  sphc_clock_id clock_ = SPHC_CLOCK_SOURCE;  // of all captures
  sphc_pairer_counts counts_ = {};
};

}  // namespace sphc
