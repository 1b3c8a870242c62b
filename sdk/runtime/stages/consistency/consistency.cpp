#include "runtime/stages/consistency/consistency.h"

#include <algorithm>

#include "runtime/base/clock.h"

namespace sphc {
namespace {

// ---- values of one image; docs/consistency.md has the evidence ----

constexpr double kMeasuredShare = 0.1;     // of the samples: fewer say nothing
constexpr double kOutOfRangeShare = 0.98;  // of the measurements
constexpr uint32_t kFewValues = 3;
constexpr uint32_t kFewestSlanted = 15;
constexpr double kMostBend = 0.7, kSureBend = 1.2;  // in frame after frame, and in one alone

// ---- edges ----

// (mean rank - kHalfway) * sqrt(edges): mostly above 0.5 where the two agree, and below 0 where they do not.
constexpr double kHalfway = 0.57;
constexpr uint32_t kFewestEdges = 6;
constexpr double kSurelyOff = -0.85, kDoubtfullyOff = 0;  // in one frame
// Summed over frames (Page's cumulative sum): how far below kUsual each is.  Frames that follow each other within
// less than kAnotherView see much the same edges, and count for a part of one.
constexpr double kUsual = 0.35, kMostAStep = 1, kDoubtful = 0.8, kAlarm = 2.2, kAllClear = 1, kMostDoubt = 4;
constexpr double kAnotherViewNs = 3e8;
// Frames of images that are apart are few where others come between them, which say nothing of them: what they said
// fades, so much a second.
constexpr double kFades = 1;

}  // namespace

void Consistency::layout(Arena &state, Arena &scratch, Consistency *consistency) {
  DepthSamples::layout(state, consistency ? &consistency->samples_ : nullptr);
  Stillness::layout(DepthSamples::kCount, state, consistency ? &consistency->stillness_ : nullptr);
  DepthEdges::layout(scratch, consistency ? &consistency->edges_ : nullptr);
}

void Consistency::init(const ConsistencyConfig &config) {
  config_ = config;
  samples_.init(config.depth_camera, config.depth_sensor, config.depth_is_range);
  reset();
}

void Consistency::reset() {
  stillness_.reset();
  together_ = apart_ = EdgeDoubt();
  doubtful_ = bent_ = false;
}

Faults Consistency::look(const ConsistencyView &view) {
  values_ = samples_.look(view.depth);
  edges_.find(view.depth, config_.depth_sensor);
  agreement_ = agreementOf(edges_.edges(), config_.depth_sensor.unit_m, view.gray, config_.color_camera,
                           config_.depth_camera, view.color_from_depth);
  Faults faults = judgeValues();
  if (config_.follows)
    faults |= stillness_.look(samples_.values(), view.depth_time_ns, view.gray, view.color_time_ns);
  doubtful_ = false;
  if (edgesDisagree(view)) faults |= kDepthColorDisagree;
  if (isBent()) faults |= kDepthBent;
  return faults;
}

Faults Consistency::judgeValues() const {
  const double least = kMeasuredShare * values_.samples;
  if (values_.measured < least) return 0;
  if (values_.measured - values_.in_range > kOutOfRangeShare * values_.measured) return kDepthRange;
  if (values_.in_range > least && values_.distinct <= kFewValues) return kDepthConstant;
  return 0;
}

bool Consistency::isBent() {
  const bool bent_before = bent_;
  bent_ = false;
  if (values_.slanted < kFewestSlanted) return false;
  bent_ = values_.bend > kMostBend;
  doubtful_ = doubtful_ || bent_;
  return values_.bend > kSureBend || (config_.follows && bent_ && bent_before);
}

bool Consistency::edgesDisagree(const ConsistencyView &view) {
  double score = 0;
  bool tells = agreement_.edges >= kFewestEdges;
  if (tells) score = (agreement_.middle() - kHalfway) * sqrtOf(static_cast<double>(agreement_.edges));
  if (tells && score < kUsual && view.hides_edges && view.hides_edges(view.gray)) tells = false;
  doubtful_ = doubtful_ || (tells && score < kDoubtfullyOff);
  if (!config_.follows) return tells && score < kSurelyOff;
  EdgeDoubt &doubt = view.are_apart ? apart_ : together_;
  const uint64_t since_ns = elapsedNs(doubt.told_time_ns, view.color_time_ns);
  double sum = doubt.told_sum;
  if (view.are_apart) sum = std::max(0.0, sum - kFades * secondsOf(since_ns));
  if (tells) {
    const double views = std::min(1.0, static_cast<double>(since_ns) / kAnotherViewNs);
    const double step = std::min(kMostAStep, std::max(-kMostAStep, kUsual - score)) * views;
    sum = std::min(kMostDoubt, std::max(0.0, sum + (score < kSurelyOff ? kMostAStep : step)));
    doubt.told_sum = sum;
    doubt.told_time_ns = view.color_time_ns;
  }
  doubtful_ = doubtful_ || sum >= kDoubtful;
  doubt.disagreed = sum >= (doubt.disagreed ? kAllClear : kAlarm);
  return doubt.disagreed;
}

}  // namespace sphc
