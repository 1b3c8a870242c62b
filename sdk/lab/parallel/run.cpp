#include "lab/parallel/run.h"

#include <chrono>
#include <cstring>
#include <memory>
#include <stdexcept>

#include "host/base/task_threads.h"
#include "host/evaluate/localize_run.h"
#include "host/report/statistics.h"
#include "lab/common/interleave.h"

namespace sphc::host {
namespace {

// Of one number of threads.
struct Contender {
  uint32_t threads;
  std::unique_ptr<TaskThreads> pool;
  sphc_localizer_config config;
  spherecloud::Localizer localizer;
};

struct Samples {
  std::vector<double> total_ms, features_ms, match_ms;
};

Contender contenderOf(const ParallelInput &input, uint32_t threads) {
  Contender made = {threads, nullptr, spherecloud::defaultConfig(), {}};
  made.config.mode = SPHC_MODE_SINGLE;
  made.config.depth_offset_sigma_m = made.config.depth_slope_sigma = 0;  // frames know nothing of each other
  setCameras(input.sequence.rig, &made.config);
  if (threads > 1) {
    made.pool = std::make_unique<TaskThreads>(threads);
    made.config.parallel = TaskThreads::run;
    made.config.parallel_user = made.pool.get();
    made.config.parallel_tasks = threads;
  }
  made.localizer = makeLocalizer(made.config, *input.maps, {});
  return made;
}

sphc_localizer_result process(const sphc_localizer_frame &frame, Contender *contender, Samples *samples) {
  using Clock = std::chrono::steady_clock;
  sphc_localizer_result result = spherecloud::emptyResult();
  const Clock::time_point begin = Clock::now();
  const spherecloud::Status status = contender->localizer.process(frame, &result);
  const std::chrono::duration<double, std::milli> took = Clock::now() - begin;
  if (status.failed()) throw std::runtime_error(status.text());
  samples->total_ms.push_back(took.count());
  samples->features_ms.push_back(1e-3 * result.features_us);
  samples->match_ms.push_back(1e-3 * result.match_us);
  result.features_us = result.align_us = result.match_us = result.pose_us = 0;
  return result;
}

void addMedians(const Samples &of_frame, Samples *medians) {
  medians->total_ms.push_back(percentile(of_frame.total_ms, 0.5));
  medians->features_ms.push_back(percentile(of_frame.features_ms, 0.5));
  medians->match_ms.push_back(percentile(of_frame.match_ms, 0.5));
}

}  // namespace

std::vector<ParallelRow> runParallel(const ParallelInput &input) {
  std::vector<Contender> contenders;
  std::vector<ParallelRow> rows;
  contenders.push_back(contenderOf(input, 1));
  for (const uint32_t threads : input.threads) contenders.push_back(contenderOf(input, threads));
  for (const Contender &contender : contenders) {
    ParallelRow row;
    row.threads = contender.threads;
    sphc_memory need = {};
    sphc_localizer_memory(&contender.config, &need, nullptr);
    row.scratch_bytes = need.scratch_bytes;
    rows.push_back(row);
  }
  Random random(1);
  std::vector<Samples> medians(rows.size());
  for (const Shot &shot : input.sequence.shots) {
    sphc_localizer_frame frame = frameOf(input.sequence, shot, rows[0].frames);
    frame.prior = nullptr;
    std::vector<Samples> of_frame(rows.size());
    std::vector<sphc_localizer_result> results(rows.size());
    for (uint32_t repeat = 0; repeat < input.repeats; ++repeat)
      for (const size_t i : shuffledOrder(rows.size(), &random))
        results[i] = process(frame, &contenders[i], &of_frame[i]);
    for (size_t i = 0; i < rows.size(); ++i) {
      ++rows[i].frames;
      rows[i].same += std::memcmp(&results[i], &results[0], sizeof results[0]) == 0;
      addMedians(of_frame[i], &medians[i]);
    }
  }
  for (size_t i = 0; i < rows.size(); ++i)
    rows[i].times = {percentile(medians[i].total_ms, 0.5), percentile(medians[i].features_ms, 0.5),
                     percentile(medians[i].match_ms, 0.5)};
  return rows;
}

}  // namespace sphc::host
