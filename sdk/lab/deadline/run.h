// Frames under deadlines: do they end in time, and how many poses are left?
#pragma once
#include <array>
#include <functional>
#include <vector>

#include "host/evaluate/map_file.h"
#include "host/evaluate/parameters.h"
#include "lab/negative/sequence.h"

namespace sphc::host {

constexpr uint32_t kLateUs = 300;  // after its deadline a frame is late

struct DeadlineInput {
  Sequence sequence;
  const std::vector<MapFile> *maps = nullptr;
  std::array<double, 3> centre_in_world_m = {};
  sphc_localizer_config config = {};  // without rig and clock
  Parameters parameters;
  uint32_t repeats = 1;
  std::vector<uint32_t> deadlines_us;  // 0: none
  bool half = false;                   // one more: half of what a frame takes without
};

struct DeadlineRow {
  uint32_t deadline_us = 0;  // 0: none; the median where it changed
  uint32_t frames = 0, in_time = 0;
  double median_us = 0, worst_us = 0;  // processor time of a frame
  uint32_t right = 0, wrong = 0;       // within 5 cm and 5 deg; beyond 25 cm or 10 deg
  uint32_t features_cut = 0, matches_cut = 0, search_cut = 0, verification_cut = 0;  // frames
};

// A row without a deadline, and then one for each.  Each frame goes through all of them before the next one, so
// that they meet the machine at the same speed; half of a frame's time is that of the median of the last ones.
// `progress` hears after each frame how many of how many are done.
std::vector<DeadlineRow> runDeadlines(const DeadlineInput &input,
                                      const std::function<void(uint32_t, uint32_t)> &progress = nullptr);

}  // namespace sphc::host
