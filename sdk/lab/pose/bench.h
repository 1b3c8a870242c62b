// One interleaved run: every query through every variant in turn, so that whatever slows the machine slows all
// alike.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "lab/pose/variant.h"

namespace sphc::host {

struct BenchOptions {
  uint32_t repeats = 5;  // of every run below 50 ms; the time is their median
  uint32_t seeds = 1;    // runs of a query, each with a seed of its own
};

// One query with one seed.
struct PoseSample {
  double seconds = 0;
  double rotation_error_deg = 0, translation_error_m = 0;
  uint32_t iterations = 0, hypotheses = 0, inliers = 0;
  bool found = false;
};

struct VariantRuns {
  std::string name;
  std::vector<PoseSample> samples;  // by query, then by seed
};

using QueryDone = std::function<void(uint32_t done, uint32_t total)>;

// Absent variants are left out, and so are those that need true points where a query has none.
std::vector<VariantRuns> runPoseBench(const std::vector<PoseCase> &cases, const std::vector<PoseVariant> &variants,
                                      const BenchOptions &options, const QueryDone &query_done);

// Angle of R R_truth^T and distance of the camera centres; an answer that is missing counts as 180 deg and 100 m.
void judgePose(const PoseAnswer &answer, const Rigid &truth_camera_from_map, PoseSample *sample);

struct Tail {
  double median = 0, p90 = 0, p99 = 0, max = 0;
};

struct VariantSummary {
  std::string name;
  size_t runs = 0;
  Tail time_ms, rotation_deg, translation_cm;
  double found_percent = 0, beyond_3cm_percent = 0, beyond_3deg_percent = 0, within_5cm_5deg_percent = 0;
  double iterations = 0;                 // median
  double hypotheses = 0;                 // mean
  double times_faster_than_poselib = 0;  // ratio of the medians; NaN without PoseLib
};

// Of one variant alone: without the ratio to another.
VariantSummary summarizeVariant(const VariantRuns &runs);

extern const char kPoseLibName[];
std::vector<VariantSummary> summarizePoseBench(const std::vector<VariantRuns> &runs);

// Keeps this process, and what it starts, on the core it runs on; gives the core, -1 when the system refuses.
int pinToOneCore();

}  // namespace sphc::host
