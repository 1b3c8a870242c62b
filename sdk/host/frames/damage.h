// What of a recording takes no part, and why.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "host/recording/recording.h"

namespace sphc::host {

// As whoever read it counted.
struct Damage {
  bool is_cut = false;
  uint64_t changed_parts = 0, lost_images = 0, backward_images = 0, bad_poses = 0, bad_accelerations = 0;
  std::string pose_fault;                 // why there are no poses
  std::vector<std::string> order_faults;  // where times go back; nothing is left out
};

Damage damageOf(const recording::Recording &recording);
// A sentence for each kind, with the cure where there is one; none for a recording that is whole.
std::vector<std::string> sentencesOf(const Damage &damage);

}  // namespace sphc::host
