// Is a confidence what it says, the share of cases that are right?
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "host/report/run.h"

namespace sphc::host {

// One answer: how sure it was, and whether it was right.
struct Graded {
  double confidence = 0;
  bool correct = false;
};

struct ReliabilityBin {
  double confidence = 0, correct = 0;  // mean, and share
  size_t count = 0;
};

constexpr size_t kReliabilityBins = 10;
// Bins of equal width over [0, 1], without those that are empty.
std::vector<ReliabilityBin> equalWidthBins(const std::vector<Graded> &graded, size_t bins = kReliabilityBins);
// Bins of equally many answers, in order of confidence.
std::vector<ReliabilityBin> equalCountBins(std::vector<Graded> graded, size_t bins = kReliabilityBins);

// Expected calibration error: |share that is right - mean confidence|, averaged over the answers (Naeini, Cooper,
// Hauskrecht 2015).  NaN of nothing.
double calibrationError(const std::vector<ReliabilityBin> &bins);

// The answers of a run that have a confidence and a truth.
std::vector<Graded> gradedFrames(const Run &run);

}  // namespace sphc::host
