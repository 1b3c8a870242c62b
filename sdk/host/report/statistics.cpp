#include "host/report/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sphc::host {
namespace {

Spread spread(const std::vector<double> &values) {
  return {percentile(values, 0.5), percentile(values, 0.9), percentile(values, 1)};
}

template <typename Get>
std::vector<double> collect(const std::vector<FrameRecord> &frames, Get get) {
  std::vector<double> values;
  values.reserve(frames.size());
  for (const FrameRecord &frame : frames) values.push_back(get(frame));
  return values;
}

void summarizeErrors(const Run &run, Summary *summary) {
  std::vector<double> rotations, translations;
  for (const FrameRecord &frame : run.frames) {
    if (!frame.has_truth) continue;
    ++summary->with_truth;
    if (isGood(frame)) ++summary->good;
    if (isWrong(frame)) ++summary->wrong;
    if (!frame.localized) continue;
    rotations.push_back(frame.rotation_error_deg);
    translations.push_back(frame.translation_error_m);
  }
  summary->rotation_deg = spread(rotations);
  summary->translation_m = spread(translations);
}

}  // namespace

const std::array<const char *, kStageCount> kStageNames = {"features", "align", "match", "pose", "total"};

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const double rank = std::clamp(share, 0.0, 1.0) * static_cast<double>(values.size() - 1);
  const size_t below = static_cast<size_t>(rank);
  const size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (rank - static_cast<double>(below)) * (values[above] - values[below]);
}

double rotationErrorDeg(const sphc_rigid &a, const sphc_rigid &b) {
  sphc_rigid b_inverse, difference;
  sphc_rigid_inverse(&b, &b_inverse);
  sphc_rigid_compose(&a, &b_inverse, &difference);
  const double *q = difference.q_wxyz;
  // atan2 keeps its accuracy at small angles, where acos(w) has none.
  return 2 * std::atan2(std::hypot(q[1], q[2], q[3]), std::abs(q[0])) * 180 / M_PI;
}

double translationErrorM(const sphc_rigid &a, const sphc_rigid &b) {
  return std::hypot(a.t_m[0] - b.t_m[0], a.t_m[1] - b.t_m[1], a.t_m[2] - b.t_m[2]);
}

void judge(FrameRecord *frame) {
  if (!frame->localized || !frame->has_truth) return;
  frame->rotation_error_deg = rotationErrorDeg(frame->base_from_camera, frame->truth_base_from_camera);
  frame->translation_error_m = translationErrorM(frame->base_from_camera, frame->truth_base_from_camera);
}

bool isGood(const FrameRecord &frame) {
  return frame.localized && frame.has_truth && frame.translation_error_m <= kGoodTranslationM &&
         frame.rotation_error_deg <= kGoodRotationDeg;
}

bool isWrong(const FrameRecord &frame) {
  return frame.localized && frame.has_truth &&
         (frame.translation_error_m > kWrongTranslationM || frame.rotation_error_deg > kWrongRotationDeg);
}

double stageMs(const FrameRecord &frame, Stage stage) {
  const std::array<uint32_t, kStageCount> us = {frame.features_us, frame.align_us, frame.match_us, frame.pose_us,
                                                frame.total_us};
  return us[stage] / 1000.0;
}

double percent(uint32_t count, uint32_t total) { return total == 0 ? 0 : 100.0 * count / total; }

std::vector<size_t> worstFrames(const Run &run, size_t most) {
  // Centimetres and degrees alike, as in the bounds.
  const auto off = [&run](size_t i) {
    const FrameRecord &frame = run.frames[i];
    return std::max(frame.translation_error_m / kWrongTranslationM, frame.rotation_error_deg / kWrongRotationDeg);
  };
  std::vector<size_t> order;
  for (size_t i = 0; i < run.frames.size(); ++i)
    if (run.frames[i].localized && run.frames[i].has_truth) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&off](size_t a, size_t b) { return off(a) > off(b); });
  order.resize(std::min(most, order.size()));
  return order;
}

Summary summarize(const Run &run) {
  Summary summary;
  summary.frames = static_cast<uint32_t>(run.frames.size());
  for (const FrameRecord &frame : run.frames) {
    if (frame.localized) ++summary.localized;
    if (frame.state == SPHC_STATE_TRACKING) ++summary.tracking;
    if (frame.localized && frame.guided) ++summary.guided;
    if (frame.cuts) ++summary.cut;
    const size_t outcome = static_cast<size_t>(frame.outcome);
    if (outcome < summary.outcomes.size()) ++summary.outcomes[outcome];
    countBits(kFaultWords, frame.faults, &summary.faults);
    countBits(kHintWords, frame.hints, &summary.hints);
  }
  summarizeErrors(run, &summary);
  for (size_t i = 0; i < kStageCount; ++i) {
    const auto stage = static_cast<Stage>(i);
    const auto ms = collect(run.frames, [stage](const FrameRecord &frame) { return stageMs(frame, stage); });
    summary.stage_median_ms[i] = percentile(ms, 0.5);
    summary.stage_p90_ms[i] = percentile(ms, 0.9);
  }
  const auto median = [&run](uint32_t FrameRecord::*field) {
    return percentile(
        collect(run.frames, [field](const FrameRecord &frame) { return static_cast<double>(frame.*field); }), 0.5);
  };
  summary.median_keypoints = median(&FrameRecord::keypoints);
  summary.median_matches = median(&FrameRecord::matches);
  summary.median_inliers = median(&FrameRecord::inliers);
  return summary;
}

}  // namespace sphc::host
