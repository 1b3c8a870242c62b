#include "lab/worst/run.h"

#include <algorithm>
#include <memory>

#include "host/evaluate/localize_run.h"
#include "host/report/statistics.h"
#include "lab/common/interleave.h"
#include "lab/common/painted_stack.h"
#include "lab/negative/run.h"

namespace sphc::host {
namespace {

constexpr double kDeadlineOfNormal = 2;

int64_t processorNanoseconds(void *) { return static_cast<int64_t>(1e9 * threadCpuSeconds()); }

MapFile copyOf(const MapFile &map) {
  const auto *bytes = static_cast<const uint8_t *>(map.bytes.data());
  return openMapBytes({bytes, bytes + map.bytes.size()});
}

// A case with its frames, its map and its localizer.
class Contender {
 public:
  Contender(const WorstInput &input, const WorstCase &of_case) : sequence_(input.sequence), config_(input.config) {
    uint64_t seed = 0;
    for (Shot &shot : sequence_.shots)
      if (of_case.spoil) of_case.spoil(++seed, sequence_, &shot);
    maps_.push_back(of_case.map ? of_case.map(*input.map) : copyOf(*input.map));
    setCameras(sequence_.rig, &config_);
    config_.clock = processorNanoseconds;
    if (of_case.max_keypoints) config_.max_keypoints = of_case.max_keypoints;
    localizer_ = makeLocalizer(config_, maps_, of_case.parameters);
  }

  const Shot &shot(size_t i) const { return sequence_.shots[i]; }
  const sphc_localizer_config &config() const { return config_; }
  // Seconds of the processor.
  double process(size_t i, uint32_t deadline_us, sphc_localizer_result *result) {
    sphc_localizer_frame frame = frameOf(sequence_, shot(i), static_cast<uint32_t>(i));
    frame.prior = nullptr;
    frame.deadline_us = deadline_us;
    *result = spherecloud::emptyResult();
    const double begin_s = threadCpuSeconds();
    const spherecloud::Status status = localizer_.process(frame, result);
    const double took_s = threadCpuSeconds() - begin_s;
    if (status.failed()) throw std::runtime_error(status.text());
    return took_s;
  }

 private:
  Sequence sequence_;
  sphc_localizer_config config_;
  std::vector<MapFile> maps_;
  spherecloud::Localizer localizer_;
};

struct Samples {
  std::vector<double> seconds, keypoints, matches, iterations;
};

void count(const WorstInput &input, const Shot &shot, const sphc_localizer_result &result, Samples *samples,
           WorstRow *row) {
  samples->keypoints.push_back(result.keypoints);
  samples->matches.push_back(result.matches);
  samples->iterations.push_back(result.iterations);
  if (result.outcome != SPHC_OUTCOME_LOCALIZED) return;
  ++row->localized;
  if (!shot.world_from_camera) return;
  const PoseError error = errorOf(result.camera_from_map, input.centre_in_world_m, *shot.world_from_camera);
  row->wrong += isWrong(error);
}

void measureMemory(Contender *contender, WorstRow *row) {
  sphc_memory need = {};
  sphc_localizer_memory(&contender->config(), &need, nullptr);
  row->state_bytes = need.state_bytes;
  row->scratch_bytes = need.scratch_bytes;
  const size_t thread_itself = deepestOf([] {});
  sphc_localizer_result result;
  row->stack_bytes = deepestOf([&] { contender->process(0, 0, &result); }) - thread_itself;
}

}  // namespace

std::vector<WorstRow> runWorst(const WorstInput &input, const std::vector<WorstCase> &cases) {
  std::vector<std::unique_ptr<Contender>> contenders;
  for (const WorstCase &each : cases) contenders.push_back(std::make_unique<Contender>(input, each));
  std::vector<WorstRow> rows(cases.size());
  std::vector<Samples> samples(cases.size());
  Random random(1);
  const size_t frames = input.sequence.shots.size();
  for (size_t i = 0; i < frames; ++i) {
    std::vector<sphc_localizer_result> results(cases.size());
    const std::vector<double> seconds = interleave(cases.size(), input.repeats, &random, [&](size_t c, uint32_t) {
      return contenders[c]->process(i, 0, &results[c]);
    });
    for (size_t c = 0; c < cases.size(); ++c) {
      samples[c].seconds.push_back(seconds[c]);
      count(input, contenders[c]->shot(i), results[c], &samples[c], &rows[c]);
    }
  }
  const double normal_s = percentile(samples[0].seconds, 0.5);
  const double deadline_s = kDeadlineOfNormal * normal_s;
  for (size_t c = 0; c < cases.size(); ++c) {
    WorstRow &row = rows[c];
    row.name = cases[c].name;
    row.frames = static_cast<uint32_t>(frames);
    row.times_normal_median = percentile(samples[c].seconds, 0.5) / normal_s;
    row.times_normal_worst = percentile(samples[c].seconds, 1) / normal_s;
    row.keypoints = percentile(samples[c].keypoints, 0.5);
    row.matches = percentile(samples[c].matches, 0.5);
    row.iterations = percentile(samples[c].iterations, 0.5);
    sphc_localizer_result result;
    for (size_t i = 0; i < frames; ++i)
      row.times_deadline_worst =
          std::max(row.times_deadline_worst,
                   contenders[c]->process(i, static_cast<uint32_t>(1e6 * deadline_s), &result) / deadline_s);
    measureMemory(contenders[c].get(), &row);
  }
  return rows;
}

void runOnce(const WorstInput &input, const WorstCase &of_case) {
  Contender contender(input, of_case);
  sphc_localizer_result result;
  for (size_t i = 0; i < input.sequence.shots.size(); ++i) contender.process(i, 0, &result);
}

}  // namespace sphc::host
