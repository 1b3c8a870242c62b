// Figures of a run: errors against the truth, percentiles, the one summary that table, JSON and report all show.
#pragma once
#include <array>
#include <vector>

#include "host/report/fault_words.h"
#include "host/report/hint_words.h"
#include "host/report/run.h"

namespace sphc::host {

constexpr double kGoodTranslationM = 0.05, kGoodRotationDeg = 5;  // the field's usual "5 cm and 5 deg"

constexpr double kWrongTranslationM = 0.25, kWrongRotationDeg = 10;  // beyond either a pose is wrong

// Linear between the two nearest ranks, as numpy does; share in [0, 1]; NaN for no values.
double percentile(std::vector<double> values, double share);

// Angle between two orientations, degrees in [0, 180].
double rotationErrorDeg(const sphc_rigid &a, const sphc_rigid &b);
// Distance between two camera centres, given base_from_camera.
double translationErrorM(const sphc_rigid &a, const sphc_rigid &b);

// Fills the two error fields of a localized frame that has truth.
void judge(FrameRecord *frame);
bool isGood(const FrameRecord &frame);
// Given out, and further from the truth than any use of it would bear.
bool isWrong(const FrameRecord &frame);

struct Spread {
  double median = 0, p90 = 0, worst = 0;  // NaN when there is nothing to measure
};

enum Stage { kFeatures, kAlign, kMatch, kPose, kTotal, kStageCount };
extern const std::array<const char *, kStageCount> kStageNames;
double stageMs(const FrameRecord &frame, Stage stage);

struct Summary {
  uint32_t frames = 0, localized = 0;
  uint32_t tracking = 0, guided = 0;  // frames after which the pose was trusted; found where it was expected
  uint32_t cut = 0;                   // frames of which the deadline left something out
  uint32_t with_truth = 0, good = 0;  // good: within 5 cm and 5 deg, of the frames with truth
  uint32_t wrong = 0;                 // beyond 25 cm or 10 deg, of the localized ones with truth
  std::array<uint32_t, SPHC_OUTCOME_CONTRADICTION + 1> outcomes = {};
  std::array<uint32_t, kFaultWords.size()> faults = {};  // frames that name each
  std::array<uint32_t, kHintWords.size()> hints = {};    // the same
  Spread rotation_deg, translation_m;                    // of the localized frames with truth
  std::array<double, kStageCount> stage_median_ms = {};
  std::array<double, kStageCount> stage_p90_ms = {};
  double median_inliers = 0, median_matches = 0, median_keypoints = 0;
};
// Indices of the localized frames with truth that are furthest from it, the furthest first.
std::vector<size_t> worstFrames(const Run &run, size_t most);
Summary summarize(const Run &run);

// count / total in percent; 0 of nothing.
double percent(uint32_t count, uint32_t total);

}  // namespace sphc::host
