// One estimator among those that are measured.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "lab/pose/case.h"

namespace sphc::host {

struct PoseAnswer {
  Rigid camera_from_map;
  uint32_t iterations = 0, hypotheses = 0, inliers = 0;  // 0 when the estimator does not tell
  bool found = false;
  double seconds = 0;  // of the estimator alone; what it needs prepared is ready
};

using PoseFunction = std::function<PoseAnswer(const PoseCase &, uint64_t seed)>;

struct PoseVariant {
  std::string name;
  bool needs_true_points = false;
  PoseFunction run;    // empty: absent
  std::string absent;  // then: why, and the cure
};

// Seconds on the clock that all variants are measured with.
double clockSeconds();

}  // namespace sphc::host
