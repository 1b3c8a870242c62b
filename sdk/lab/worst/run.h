// What hostile frames and maps cost beside the frames and the map that they were made from.
#pragma once
#include "lab/worst/cases.h"

namespace sphc::host {

struct WorstInput {
  Sequence sequence;
  const MapFile *map = nullptr;
  std::array<double, 3> centre_in_world_m = {};
  sphc_localizer_config config = {};  // without rig and clock
  uint32_t repeats = 1;               // of each frame; what is slow runs once
};

struct WorstRow {
  std::string name;
  uint32_t frames = 0;
  // Processor time over the median of a normal frame: the median over the frames, and the worst frame.
  double times_normal_median = 0, times_normal_worst = 0;
  double times_deadline_worst = 0;                    // time over a deadline of twice the median of a normal frame
  uint32_t localized = 0, wrong = 0;                  // without a deadline
  double keypoints = 0, matches = 0, iterations = 0;  // medians
  uint64_t stack_bytes = 0, state_bytes = 0, scratch_bytes = 0;
};

std::vector<WorstRow> runWorst(const WorstInput &input, const std::vector<WorstCase> &cases);
// Each frame once and nothing else, for a program that counts instructions.
void runOnce(const WorstInput &input, const WorstCase &of_case);

}  // namespace sphc::host
