// Times of a device's clock on the host's, from pairs of a source time and its arrival.
//
// arrival = source time + offset + drift + delay, where the delay varies but has a least value.  So the mapping is
// the line that lies below all samples and nearest to them: the edge of their lower convex hull above the middle of
// their times (S. B. Moon, P. Skelly, D. Towsley: Estimation and removal of clock skew from network delay
// measurements, INFOCOM 1999).  The window is cut into slots that keep their quickest arrival each, which bounds
// memory and time.
#pragma once
#include "spherecloud/spherecloud_capture.h"

namespace sphc {

class ClockMapper {
 public:
  explicit ClockMapper(const sphc_clock_mapper_config &config) : config_(config) {}

  sphc_status add(int64_t source_ns, int64_t arrival_ns);
  sphc_status map(int64_t source_ns, int64_t *host_ns) const;
  sphc_status get(sphc_clock_mapping *mapping) const;

 private:
  // A sample, seen from the first one: seconds on the source's clock, and by how much its delay exceeds the
  // first's.
  struct Sample {
    double source_s, late_s;
  };
  static constexpr uint32_t kSlots = 32;

  void start(int64_t source_ns, int64_t arrival_ns);
  enum class Fit { kGood, kLate, kJump };
  Fit judge(int64_t source_ns, const Sample &sample);
  void keep(const Sample &sample);
  void fitLine();
  double lateAt(double source_s) const { return level_s_ + slope_ * (source_s - at_s_); }

  sphc_clock_mapper_config config_;
  // The first sample, which the others are told from.
  int64_t first_source_ns_ = 0, first_arrival_ns_ = 0;
  int64_t last_source_ns_ = 0;
  uint32_t samples_ = 0, restarts_ = 0;
  uint32_t late_in_a_row_ = 0;

  Sample slots_[kSlots] = {};  // in order of time; the quickest of each
  double slot_ends_s_ = 0;     // the newest one
  uint32_t count_ = 0;

  double at_s_ = 0, level_s_ = 0, slope_ = 0;  // the line
  double scatter_s_ = 0;
};

}  // namespace sphc
