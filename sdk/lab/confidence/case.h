// Queries of every difficulty, from hopeless to easy: what a confidence is fitted to and judged by.
#pragma once
#include "lab/pose/case.h"
#include "runtime/base/random.h"
#include "runtime/types/depth_calibration.h"

namespace sphc::host {

struct ConfidenceQuery {
  PoseCase pose_case;
  DepthCalibration depth;  // what is known of the sensor by then
};

// What makes a query hard.
struct Hardship {
  size_t rows = 0;           // with depth that are left, a random choice; 0: all
  double eta = 1;            // share of true rows, when that is less than there are
  double depth_noise = 1;    // over what is believed: above 1 noise is added, below 1 rows state more
  bool wrong_place = false;  // directions shuffled between rows: every pose found is wrong
};
Hardship drawHardship(Random *random);
std::string describe(const Hardship &hardship);  // "rows 40, eta 25, depth noise 2.0"

ConfidenceQuery hardQuery(const ConfidenceQuery &original, const Hardship &hardship, const CaseNoise &noise,
                          Random *random);

// Made-up worlds in which all rows are true.  A: a furnished room, its sphere centre in the middle.  B: objects
// that stand about, seen by a wide camera with coarser pixels, the sphere centre elsewhere.
enum class MadeWorld { kRoom, kObjects };
const char *worldName(MadeWorld world);  // "made room", "made objects"
// Every second seed's sensor has been calibrated: its bias is known five times better than at first.
ConfidenceQuery madeQuery(MadeWorld world, uint64_t seed, const CaseNoise &noise);

}  // namespace sphc::host
