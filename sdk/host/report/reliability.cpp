#include "host/report/reliability.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/report/statistics.h"

namespace sphc::host {
namespace {

// Sums; finish() makes means of them.
void add(const Graded &graded, ReliabilityBin *bin) {
  bin->confidence += graded.confidence;
  bin->correct += graded.correct ? 1 : 0;
  ++bin->count;
}

std::vector<ReliabilityBin> finish(const std::vector<ReliabilityBin> &sums) {
  std::vector<ReliabilityBin> bins;
  for (const ReliabilityBin &sum : sums) {
    const double count = static_cast<double>(sum.count);
    if (sum.count > 0) bins.push_back({sum.confidence / count, sum.correct / count, sum.count});
  }
  return bins;
}

}  // namespace

std::vector<ReliabilityBin> equalWidthBins(const std::vector<Graded> &graded, size_t bins) {
  std::vector<ReliabilityBin> sums(bins);
  for (const Graded &g : graded) {
    const double place = std::clamp(g.confidence, 0.0, 1.0) * static_cast<double>(bins);
    add(g, &sums[std::min(static_cast<size_t>(place), bins - 1)]);
  }
  return finish(sums);
}

std::vector<ReliabilityBin> equalCountBins(std::vector<Graded> graded, size_t bins) {
  std::stable_sort(graded.begin(), graded.end(),
                   [](const Graded &a, const Graded &b) { return a.confidence < b.confidence; });
  std::vector<ReliabilityBin> sums(bins);
  for (size_t i = 0; i < graded.size(); ++i) add(graded[i], &sums[i * bins / graded.size()]);
  return finish(sums);
}

double calibrationError(const std::vector<ReliabilityBin> &bins) {
  double error = 0, count = 0;
  for (const ReliabilityBin &bin : bins) {
    error += static_cast<double>(bin.count) * std::abs(bin.correct - bin.confidence);
    count += static_cast<double>(bin.count);
  }
  return count > 0 ? error / count : std::numeric_limits<double>::quiet_NaN();
}

std::vector<Graded> gradedFrames(const Run &run) {
  std::vector<Graded> graded;
  for (const FrameRecord &frame : run.frames)
    if (frame.localized && frame.has_truth && frame.confidence)
      graded.push_back({*frame.confidence, isGood(frame)});
  return graded;
}

}  // namespace sphc::host
