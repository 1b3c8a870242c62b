#include "host/guide/stretch_causes.h"

#include "host/guide/advice.h"
#include "host/mapping/view_speed.h"
#include "host/mapping/walk_times.h"
#include "host/report/run.h"

namespace sphc::host {
namespace {

constexpr double kMostOutOfRange = 0.5;  // of what was measured

std::string percent(double share) { return fixed(100 * share, 0) + " %"; }

StretchCause causeOf(GuideAdvice bit, const std::string &measured) {
  const BitWords &words = wordsOf(bit);
  return {words.name, measured, words.cure};
}

StretchCause depthCause(const ImageEvidence &images) {
  const std::string with_depth = percent(images.with_depth) + " of the keypoints have depth";
  if (images.nearer > kMostOutOfRange)
    return {"too near", with_depth + ", " + percent(images.nearer) + " of the depths are nearer than --depth-min",
            "step back"};
  if (images.farther > kMostOutOfRange)
    return {"too far", with_depth + ", " + percent(images.farther) + " of the depths are beyond --depth-max",
            "step closer"};
  return causeOf(kOtherRange, with_depth);
}

std::string speedText(const Stretch &stretch) {
  const double speed = stretch.evidence.view_per_s;
  const std::string moves = "around it the view moves by " + fixed(speed, 1) + " focal lengths a second";
  if (!(stretch.hints & kTooFast)) return moves;
  return "blurred along a line" + (speed > kFastPerS ? ", and " + moves : "");
}

}  // namespace

std::vector<StretchCause> causesOf(const Stretch &stretch) {
  const StretchEvidence &evidence = stretch.evidence;
  std::vector<StretchCause> causes;
  if (isPause(evidence.gap_s, evidence.usual_gap_s))
    causes.push_back({"gap in time", "no frame for " + fixed(evidence.gap_s, 1) + " s",
                      "go back to what was seen before it, and record without a pause"});
  if (stretch.hints & kTooDark)
    causes.push_back(causeOf(kMoreLight, "median grey level " + fixed(evidence.images.level, 0) + " of 255"));
  if (stretch.hints & kNoDepthInRange) causes.push_back(depthCause(evidence.images));
  if ((stretch.hints & kTooFast) || evidence.view_per_s > kFastPerS)
    causes.push_back(causeOf(kSlower, speedText(stretch)));
  if (stretch.hints & kTooPlain)
    causes.push_back(causeOf(kMoreTexture, fixed(evidence.images.keypoints, 0) + " keypoints"));
  return causes;
}

std::string causesText(const std::vector<StretchCause> &causes) {
  if (causes.empty()) return std::string("they show nothing that other frames show: ") + wordsOf(kLookAgain).cure;
  std::string text;
  for (const StretchCause &cause : causes)
    text += (text.empty() ? "" : "; ") + cause.name + " (" + cause.measured + "): " + cause.cure;
  return text;
}

}  // namespace sphc::host
