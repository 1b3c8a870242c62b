// What a buffer's timestamp means: which point of the exposure, and how sure that is.
#pragma once

#include <spherecloud/spherecloud_capture.h>

namespace sphc::v4l2 {

class FrameClock {
 public:
  // No frame is older than `now_ns`.  `period_ns` 0: not known.
  void restart(int64_t now_ns, int64_t period_ns);
  // No frame waited to be taken: those taken later came after `now_ns`.
  void sawNoFrame(int64_t now_ns) { no_frame_ns_ = now_ns; }
  void setExposure(uint32_t exposure_us) { exposure_us_ = exposure_us; }  // 0: not known

  struct Stamp {
    int64_t time_ns;
    sphc_time_point time_point;
    uint32_t exposure_us;
    uint32_t time_sigma_us;
    bool is_replaced;  // the device's time could not be, so it is that of arrival
  };
  // False: neither the device's time nor that of arrival is later than the last stamp's; or the device's could be,
  // but the last stamp is the arrival of an earlier frame whose own could not.
  // `device_time_ns` negative: one that cannot be.
  bool stamp(int64_t device_time_ns, uint32_t buffer_flags, int64_t arrival_ns, Stamp *stamp);

 private:
  Stamp ofDevice(int64_t device_time_ns, bool is_end) const;
  Stamp ofArrival(int64_t arrival_ns) const;
  bool isPossible(int64_t time_ns, int64_t arrival_ns) const;

  int64_t start_ns_ = 0;
  int64_t last_ns_ = INT64_MIN;
  int64_t last_own_ns_ = INT64_MIN;  // of a frame that was not replaced
  uint32_t overtaken_ = 0;           // frames since, by a replaced one's arrival
  int64_t no_frame_ns_ = 0;
  int64_t period_ns_ = 0;
  uint32_t exposure_us_ = 0;
};

}  // namespace sphc::v4l2
