#include "lab/deadline/run.h"

#include <time.h>

#include <algorithm>

#include "host/evaluate/localize_run.h"
#include "host/report/statistics.h"
#include "lab/negative/run.h"

namespace sphc::host {
namespace {

constexpr double kRightM = 0.05, kRightDeg = 5;

// Of this thread: what other programs of a machine take does not count.
int64_t processorNanoseconds(void *) {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return now.tv_sec * 1000000000ll + now.tv_nsec;
}

void count(const DeadlineInput &input, const Shot &shot, const sphc_localizer_result &result, DeadlineRow *row) {
  row->features_cut += (result.cuts & SPHC_CUT_FEATURES) != 0;
  row->matches_cut += (result.cuts & SPHC_CUT_MATCHES) != 0;
  row->search_cut += (result.cuts & SPHC_CUT_SEARCH) != 0;
  row->verification_cut += (result.cuts & SPHC_CUT_VERIFICATION) != 0;
  if (result.outcome != SPHC_OUTCOME_LOCALIZED || !shot.world_from_camera) return;
  const PoseError error = errorOf(result.camera_from_map, input.centre_in_world_m, *shot.world_from_camera);
  row->right += error.translation_m <= kRightM && error.rotation_deg <= kRightDeg;
  row->wrong += error.translation_m > kWrongM || error.rotation_deg > kWrongDeg;
}

}  // namespace

DeadlineRow runDeadline(const DeadlineInput &input, uint32_t deadline_us) {
  DeadlineRow row;
  row.deadline_us = deadline_us;
  std::vector<double> times_us;
  for (uint32_t repeat = 0; repeat < input.repeats; ++repeat) {
    sphc_localizer_config config = input.config;
    setCameras(input.sequences.front().rig, &config);
    config.clock = processorNanoseconds;
    config.seed += repeat;
    spherecloud::Localizer localizer = makeLocalizer(config, *input.maps, input.parameters);
    for (const Sequence &sequence : input.sequences)
      for (const Shot &shot : sequence.shots) {
        sphc_localizer_frame frame = frameOf(sequence, shot, row.frames++);
        frame.prior = nullptr;
        frame.deadline_us = deadline_us;
        sphc_localizer_result result = spherecloud::emptyResult();
        const int64_t begin = processorNanoseconds(nullptr);
        const spherecloud::Status status = localizer.process(frame, &result);
        times_us.push_back(static_cast<double>(processorNanoseconds(nullptr) - begin) / 1000);
        if (status.failed()) throw std::runtime_error(status.text());
        row.in_time += deadline_us == 0 || times_us.back() <= deadline_us + kLateUs;
        count(input, shot, result, &row);
      }
  }
  row.median_us = percentile(times_us, 0.5);
  row.worst_us = *std::max_element(times_us.begin(), times_us.end());
  return row;
}

}  // namespace sphc::host
