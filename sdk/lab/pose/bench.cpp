#include "lab/pose/bench.h"

#include <sched.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "host/report/statistics.h"
#include "lab/common/interleave.h"
#include "lab/common/pose_error.h"

namespace sphc::host {
namespace {

constexpr double kMissingDeg = 180, kMissingM = 100;

uint64_t seedOf(size_t query, uint32_t seed) { return 1 + 1000003 * static_cast<uint64_t>(seed) + query; }

std::vector<const PoseVariant *> presentVariants(const std::vector<PoseVariant> &variants,
                                                 const std::vector<PoseCase> &cases) {
  bool true_points = true;
  for (const PoseCase &c : cases) true_points &= c.correspondences.empty() || !c.true_points_map_m.empty();
  std::vector<const PoseVariant *> present;
  for (const PoseVariant &variant : variants)
    if (variant.run && (true_points || !variant.needs_true_points)) present.push_back(&variant);
  return present;
}

// All variants on one query with one seed.
std::vector<PoseSample> runQuery(const PoseCase &c, uint64_t seed, uint32_t repeats,
                                 const std::vector<const PoseVariant *> &variants) {
  Random random(seed);
  std::vector<PoseSample> samples(variants.size());
  const auto seconds = interleave(variants.size(), repeats, &random, [&](size_t chosen, uint32_t repeat) {
    const PoseAnswer answer = variants[chosen]->run(c, seed);
    if (repeat == 0) judgePose(answer, c.truth_camera_from_map, &samples[chosen]);
    return answer.seconds;
  });
  for (size_t i = 0; i < variants.size(); ++i) samples[i].seconds = seconds[i];
  return samples;
}

template <typename Get>
Tail tailOf(const std::vector<PoseSample> &samples, Get get) {
  std::vector<double> values;
  for (const PoseSample &sample : samples) values.push_back(get(sample));
  return {percentile(values, 0.5), percentile(values, 0.9), percentile(values, 0.99), percentile(values, 1)};
}

template <typename Is>
double shareOf(const std::vector<PoseSample> &samples, Is is) {
  const auto count = std::count_if(samples.begin(), samples.end(), is);
  return percent(static_cast<uint32_t>(count), static_cast<uint32_t>(samples.size()));
}

}  // namespace

const char kPoseLibName[] = "poselib p3p";

VariantSummary summarizeVariant(const VariantRuns &runs) {
  using Sample = const PoseSample &;
  VariantSummary s;
  s.name = runs.name;
  s.runs = runs.samples.size();
  s.time_ms = tailOf(runs.samples, [](Sample a) { return 1e3 * a.seconds; });
  s.rotation_deg = tailOf(runs.samples, [](Sample a) { return a.rotation_error_deg; });
  s.translation_cm = tailOf(runs.samples, [](Sample a) { return 100 * a.translation_error_m; });
  s.iterations = tailOf(runs.samples, [](Sample a) { return static_cast<double>(a.iterations); }).median;
  for (const PoseSample &sample : runs.samples) s.hypotheses += sample.hypotheses;
  if (s.runs > 0) s.hypotheses /= static_cast<double>(s.runs);
  s.found_percent = shareOf(runs.samples, [](Sample a) { return a.found; });
  s.beyond_3cm_percent = shareOf(runs.samples, [](Sample a) { return a.translation_error_m > 0.03; });
  s.beyond_3deg_percent = shareOf(runs.samples, [](Sample a) { return a.rotation_error_deg > 3; });
  s.within_5cm_5deg_percent = shareOf(runs.samples, [](Sample a) {
    return a.translation_error_m <= kGoodTranslationM && a.rotation_error_deg <= kGoodRotationDeg;
  });
  return s;
}

double clockSeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void judgePose(const PoseAnswer &answer, const Rigid &truth, PoseSample *sample) {
  const Rigid &pose = answer.camera_from_map;
  const bool sound = answer.found && std::isfinite(pose.rotation.sum() + pose.translation_m.sum());
  sample->iterations = answer.iterations;
  sample->hypotheses = answer.hypotheses;
  sample->inliers = answer.inliers;
  sample->found = sound;
  sample->rotation_error_deg = sound ? turnRad(pose, truth) * 180 / kPi : kMissingDeg;
  sample->translation_error_m = sound ? shiftM(pose, truth) : kMissingM;
}

std::vector<VariantRuns> runPoseBench(const std::vector<PoseCase> &cases, const std::vector<PoseVariant> &variants,
                                      const BenchOptions &options, const QueryDone &query_done) {
  const std::vector<const PoseVariant *> present = presentVariants(variants, cases);
  std::vector<VariantRuns> runs;
  for (const PoseVariant *variant : present) runs.push_back({variant->name, {}});
  for (size_t query = 0; query < cases.size(); ++query) {
    for (uint32_t seed = 0; seed < options.seeds; ++seed) {
      const auto samples = runQuery(cases[query], seedOf(query, seed), options.repeats, present);
      for (size_t i = 0; i < runs.size(); ++i) runs[i].samples.push_back(samples[i]);
    }
    if (query_done) query_done(static_cast<uint32_t>(query + 1), static_cast<uint32_t>(cases.size()));
  }
  return runs;
}

std::vector<VariantSummary> summarizePoseBench(const std::vector<VariantRuns> &runs) {
  std::vector<VariantSummary> summaries;
  double poselib_ms = std::numeric_limits<double>::quiet_NaN();
  for (const VariantRuns &variant : runs) {
    summaries.push_back(summarizeVariant(variant));
    if (variant.name == kPoseLibName) poselib_ms = summaries.back().time_ms.median;
  }
  for (VariantSummary &summary : summaries) summary.times_faster_than_poselib = poselib_ms / summary.time_ms.median;
  return summaries;
}

int pinToOneCore() {
  const int core = sched_getcpu();
  if (core < 0) return -1;
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<size_t>(core), &set);
  return sched_setaffinity(0, sizeof set, &set) == 0 ? core : -1;
}

}  // namespace sphc::host
