#include "lab/hints/run.h"

#include "host/evaluate/localize_run.h"
#include "host/report/hint_words.h"

namespace sphc::host {
namespace {

void count(const HintCondition &condition, const sphc_localizer_result &result, HintRow *row) {
  ++row->frames;
  if (result.outcome == SPHC_OUTCOME_LOCALIZED) return;
  ++row->without_pose;
  row->told += condition.hint ? (result.hints & condition.hint) != 0 : result.hints == 0;
  countBits(kHintWords, result.hints, &row->hints);
}

void runSequence(const HintInput &input, const HintCondition &condition, const Sequence &sequence,
                 sphc_localizer_mode mode, HintRow *row) {
  if (sequence.shots.empty()) return;
  sphc_localizer_config config = spherecloud::defaultConfig();
  setCameras(sequence.rig, &config);
  config.mode = mode;
  spherecloud::Localizer localizer = makeLocalizer(config, *input.maps);
  for (const Shot &shot : sequence.shots) {
    sphc_localizer_frame frame = frameOf(sequence, shot, row->frames);
    frame.prior = nullptr;
    sphc_localizer_result result = spherecloud::emptyResult();
    const spherecloud::Status status = localizer.process(frame, &result);
    if (status.failed()) throw std::runtime_error(condition.name + ": " + status.text());
    count(condition, result, row);
  }
}

}  // namespace

std::vector<HintRow> runHints(const HintInput &input, const std::vector<HintCondition> &conditions,
                              const HintRowDone &done) {
  std::vector<HintRow> rows;
  for (const HintCondition &condition : conditions) {
    HintRow single, tracking;
    single.condition = tracking.condition = condition.name;
    single.mode = "single";
    tracking.mode = "tracking";
    for (const Sequence &healthy : input.sequences) {
      Sequence sequence = healthy;
      condition.apply(&sequence);
      runSequence(input, condition, sequence, SPHC_MODE_SINGLE, &single);
      runSequence(input, condition, sequence, SPHC_MODE_TRACKING, &tracking);
    }
    rows.push_back(single);
    rows.push_back(tracking);
    done(static_cast<uint32_t>(rows.size()), static_cast<uint32_t>(2 * conditions.size()));
  }
  return rows;
}

}  // namespace sphc::host
