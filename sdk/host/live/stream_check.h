// What a stream of captures looks like: rate, losses, clock, size, brightness or depth.
#pragma once
#include <optional>
#include <utility>
#include <vector>

#include "host/live/finding.h"
#include "host/recording/calibration.h"
#include "spherecloud/spherecloud_capture.h"

namespace sphc::host {

class StreamCheck {
 public:
  // is_recording: what comes was recorded, so no camera can be helped.
  StreamCheck(sphc_stream stream, const sphc_rig &calibration, bool is_recording);

  // The times of the images that a recording has: one that is not looked at cannot be read.
  void expect(std::vector<int64_t> times_ns) { expected_ns_ = std::move(times_ns); }
  void look(const sphc_capture &capture);
  uint32_t count() const { return count_; }  // of captures
  // Of this stream alone; nothing else is said where not one capture came.
  Findings findings() const;

 private:
  uint64_t unreadable() const;
  uint64_t lost() const;
  Finding rate() const;
  std::optional<Finding> frozen() const;  // where it is
  Finding clock() const;
  std::optional<Finding> size() const;  // where it is wrong
  Finding brightness() const;
  Finding depths() const;

  bool is_color_, is_recording_;
  sphc_camera camera_;
  double depth_unit_m_;
  sphc_capture first_ = {}, last_ = {};
  uint32_t count_ = 0, repeated_ = 0;
  uint64_t last_pixels_ = 0;  // a hash of those looked at
  std::vector<int64_t> expected_ns_;
  std::vector<double> steps_;  // from a number to the next
  std::vector<double> periods_ms_, brightness_, depths_m_, measured_share_;
};

// Captures of both streams.
struct StreamCounts {
  uint64_t color = 0, depth = 0;  // that came
  uint64_t without_partner = 0;   // of both; what still waits is not counted
};
// Of pairs: how far apart they were taken, and whether the rarer stream's images found one.
Finding pairsFinding(const std::vector<double> &color_minus_depth_ms, const StreamCounts &counts);

}  // namespace sphc::host
