// The pose stage on hard cases: what it says of itself, and whether it is right.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "lab/confidence/case.h"
#include "runtime/stages/pose/confidence.h"

namespace sphc::host {

// One pose.
struct ConfidenceRun {
  std::string hardship;
  ConfidenceInputs inputs;
  double rotation_error_deg = 0, translation_error_m = 0;
  bool correct = false;  // within 5 cm and 5 deg
};

struct ConfidenceScene {
  std::string name;
  bool fitted_on = false;  // else only shown
  std::vector<ConfidenceRun> runs;
};

using RunDone = std::function<void(uint32_t done, uint32_t total)>;

// Queries of one recording, each with what a sensor's calibration knows after those before it.
std::vector<ConfidenceQuery> calibratedQueries(const std::vector<PoseCase> &cases);
// Each of the queries `times` times, every time with other hardships.  Where no pose comes out there is nothing to
// be confident of.
void runConfidence(const std::vector<ConfidenceQuery> &queries, const CaseNoise &noise, uint32_t times,
                   uint64_t seed, const RunDone &done, std::vector<ConfidenceRun> *runs);
ConfidenceScene runMadeWorlds(MadeWorld world, uint32_t count, uint64_t seed, const RunDone &done);

}  // namespace sphc::host
