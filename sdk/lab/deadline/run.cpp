#include "lab/deadline/run.h"

#include <algorithm>
#include <utility>

#include "host/evaluate/localize_run.h"
#include "host/report/statistics.h"
#include "lab/deadline/processor_clock.h"
#include "lab/negative/run.h"

namespace sphc::host {
namespace {

int64_t nowOf(void *clock) { return static_cast<ProcessorClock *>(clock)->now_ns(); }

void count(const DeadlineInput &input, const Shot &shot, const sphc_localizer_result &result, DeadlineRow *row) {
  row->features_cut += (result.cuts & SPHC_CUT_FEATURES) != 0;
  row->matches_cut += (result.cuts & SPHC_CUT_MATCHES) != 0;
  row->search_cut += (result.cuts & SPHC_CUT_SEARCH) != 0;
  row->verification_cut += (result.cuts & SPHC_CUT_VERIFICATION) != 0;
  if (result.outcome != SPHC_OUTCOME_LOCALIZED || !shot.world_from_camera) return;
  const PoseError error = errorOf(result.camera_from_map, input.centre_in_world_m, *shot.world_from_camera);
  row->right += isGood(error);
  row->wrong += isWrong(error);
}

// One deadline, and what came of the frames under it.
struct Lane {
  DeadlineRow row;
  bool half = false;
  std::vector<double> times_us;
  std::vector<uint32_t> deadlines_us;
};

std::vector<Lane> lanesOf(const DeadlineInput &input) {
  std::vector<Lane> lanes(1);
  for (const uint32_t deadline_us : input.deadlines_us) {
    lanes.emplace_back();
    lanes.back().row.deadline_us = deadline_us;
  }
  if (input.half) lanes.emplace_back();
  lanes.back().half = input.half;
  return lanes;
}

std::vector<spherecloud::Localizer> localizersOf(const DeadlineInput &input, size_t count, uint32_t repeat,
                                                 ProcessorClock *clock) {
  sphc_localizer_config config = input.config;
  setCameras(input.sequence.rig, &config);
  config.clock = nowOf;
  config.clock_user = clock;
  config.seed += repeat;
  std::vector<spherecloud::Localizer> localizers;
  for (size_t i = 0; i < count; ++i) localizers.push_back(makeLocalizer(config, *input.maps, input.parameters));
  return localizers;
}

uint32_t halfOf(const std::vector<double> &times_us) {
  constexpr std::ptrdiff_t kLast = 31;
  const auto count = std::min(static_cast<std::ptrdiff_t>(times_us.size()), kLast);
  return static_cast<uint32_t>(percentile({times_us.end() - count, times_us.end()}, 0.5) / 2);
}

void process(const DeadlineInput &input, const Shot &shot, spherecloud::Localizer *localizer, ProcessorClock *clock,
             Lane *lane) {
  DeadlineRow &row = lane->row;
  sphc_localizer_frame frame = frameOf(input.sequence, shot, row.frames++);
  frame.prior = nullptr;
  frame.deadline_us = row.deadline_us;
  sphc_localizer_result result = spherecloud::emptyResult();
  const int64_t begin_ns = clock->now_ns();
  const spherecloud::Status status = localizer->process(frame, &result);
  lane->times_us.push_back(static_cast<double>(clock->now_ns() - begin_ns) / 1000);
  if (status.failed()) throw std::runtime_error(status.text());
  row.in_time += row.deadline_us == 0 || lane->times_us.back() <= row.deadline_us + kLateUs;
  count(input, shot, result, &row);
}

DeadlineRow rowOf(Lane lane) {
  lane.row.median_us = percentile(lane.times_us, 0.5);
  lane.row.worst_us = *std::max_element(lane.times_us.begin(), lane.times_us.end());
  if (lane.half) {
    std::sort(lane.deadlines_us.begin(), lane.deadlines_us.end());
    lane.row.deadline_us = lane.deadlines_us[lane.deadlines_us.size() / 2];
  }
  return lane.row;
}

}  // namespace

std::vector<DeadlineRow> runDeadlines(const DeadlineInput &input,
                                      const std::function<void(uint32_t, uint32_t)> &progress) {
  std::vector<Lane> lanes = lanesOf(input);
  ProcessorClock clock;
  const uint32_t total = input.repeats * static_cast<uint32_t>(input.sequence.shots.size());
  for (uint32_t repeat = 0; repeat < input.repeats; ++repeat) {
    std::vector<spherecloud::Localizer> localizers = localizersOf(input, lanes.size(), repeat, &clock);
    for (const Shot &shot : input.sequence.shots) {
      for (size_t i = 0; i < lanes.size(); ++i) {
        if (lanes[i].half) lanes[i].deadlines_us.push_back(lanes[i].row.deadline_us = halfOf(lanes[0].times_us));
        process(input, shot, &localizers[i], &clock, &lanes[i]);
      }
      if (progress) progress(lanes[0].row.frames, total);
    }
  }
  std::vector<DeadlineRow> rows;
  for (Lane &lane : lanes) rows.push_back(rowOf(std::move(lane)));
  return rows;
}

}  // namespace sphc::host
