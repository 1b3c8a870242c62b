// Made-up runs for the tests of the report.
#pragma once
#include <cmath>

#include "host/report/statistics.h"

namespace sphc::host {

inline sphc_rigid poseAt(double x, double y, double z, double yaw_deg = 0) {
  const double half = yaw_deg * M_PI / 360;
  return {{std::cos(half), 0, 0, std::sin(half)}, {x, y, z}};
}

// A localized frame that is `error_m` off along x and `error_deg` turned.
inline FrameRecord goodFrame(uint32_t sequence, double error_m, double error_deg) {
  FrameRecord frame;
  frame.sequence = sequence;
  frame.time_ns = sequence * int64_t{100000000};
  frame.outcome = SPHC_OUTCOME_LOCALIZED;
  frame.localized = frame.has_truth = true;
  frame.keypoints = 100;
  frame.matches = 60;
  frame.inliers = 40;
  frame.total_us = 10000 + sequence;
  frame.truth_base_from_camera = poseAt(0.1 * sequence, 0.02 * sequence * sequence, 1);
  frame.base_from_camera = poseAt(0.1 * sequence + error_m, 0.02 * sequence * sequence, 1, error_deg);
  frame.observations = {{20, 20, 2, 1, 0, 0, 0},
                        {30, 30, 2, 1, 1, SPHC_OBSERVATION_MATCHED | SPHC_OBSERVATION_INLIER, 0}};
  judge(&frame);
  return frame;
}

inline FrameRecord lostFrame(uint32_t sequence) {
  FrameRecord frame;
  frame.sequence = sequence;
  frame.outcome = SPHC_OUTCOME_NO_CONSENSUS;
  frame.has_truth = true;
  return frame;
}

}  // namespace sphc::host
