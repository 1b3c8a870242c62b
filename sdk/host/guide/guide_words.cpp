#include "host/guide/guide_words.h"

#include <algorithm>
#include <cmath>

#include "host/base/in_seconds.h"
#include "host/report/run.h"

namespace sphc::host {
namespace {

constexpr int64_t kAdviceStaysNs = 1500000000, kLoopStaysNs = 3000000000;

double rounded(double value) { return std::round(100 * value) / 100; }

std::string ago(double seconds) { return fixed(seconds, 0) + " s ago"; }

// The lowest bit is the most urgent.
GuideAdvice mostUrgent(GuideAdvice advice) { return advice & (~advice + 1); }

std::string cureOf(GuideAdvice bit) { return bit ? wordsOf(bit).cure : ""; }

std::string adviceText(GuideAdvice urgent, const GuideStep &step) {
  if (urgent != kGoBack) return cureOf(urgent);
  // To look again here is no way back.
  const std::string cause = cureOf(mostUrgent(step.advice & ~(kGoBack | kLookAgain)));
  return "LOST: go back to where you were " + ago(step.lost_s) + (cause.empty() ? "" : " (" + cause + ")");
}

std::string loopText(const ClosedLoop &loop, int64_t now_ns) {
  if (loop.is_begin) return "you are back where you began: a loop is closed";
  return "you are back where you were " + ago(inSeconds(now_ns - loop.time_then_ns)) + ": a loop is closed";
}

// A glance elsewhere is none.  In a slow recording no two lost frames may be near each other.
bool hasLostStretches(const WalkSummary &s) {
  return 2 * s.followed < s.frames || std::any_of(s.hard.begin(), s.hard.end(), [](const HardStretch &stretch) {
           return (stretch.advice & kGoBack) != 0;
         });
}

}  // namespace

const std::string &GuideLine::hear(const GuideStep &step) {
  const GuideAdvice urgent = mostUrgent(step.advice & (before_ | kGoBack));
  before_ = step.advice;
  const bool may_speak = step.time_ns >= until_ns_ || urgent == said_ || (urgent && (!said_ || urgent < said_));
  if (step.loop && step.loop->is_new && urgent != kGoBack) {
    text_ = loopText(*step.loop, step.time_ns);
    said_ = 0;
    until_ns_ = step.time_ns + kLoopStaysNs;
  } else if (urgent && may_speak) {
    text_ = adviceText(urgent, step);
    said_ = urgent;
    until_ns_ = step.time_ns + kAdviceStaysNs;
  } else if (step.time_ns >= until_ns_) {
    text_ = "good";
    said_ = 0;
  }
  return text_;
}

nlohmann::ordered_json stepJson(const GuideStep &step) {
  nlohmann::ordered_json json = {
      {"time_ns", step.time_ns}, {"sequence", step.sequence}, {"advice", namesOf(kAdviceWords, step.advice)},
      {"places", step.places},   {"parts", step.parts},       {"loops", step.loops}};
  if (step.advice & kGoBack) json["lost_s"] = rounded(step.lost_s);
  if (step.loop) {
    const sphc_rigid pose = rigidToC(step.loop->now_from_then);
    json["loop"] = {{"sequence", step.loop->sequence_then},
                    {"time_ns", step.loop->time_then_ns},
                    {"is_begin", step.loop->is_begin},
                    {"is_new", step.loop->is_new},
                    {"now_from_then", {{"q_wxyz", pose.q_wxyz}, {"t_m", pose.t_m}}}};
  }
  return json;
}

nlohmann::ordered_json summaryJson(const WalkSummary &s) {
  nlohmann::ordered_json hard = nlohmann::ordered_json::array();
  for (const HardStretch &stretch : s.hard)
    hard.push_back({{"from_s", rounded(stretch.from_s)},
                    {"to_s", rounded(stretch.to_s)},
                    {"advice", namesOf(kAdviceWords, stretch.advice)}});
  return {{"frames", s.frames},
          {"followed", s.followed},
          {"seconds", rounded(s.seconds)},
          {"path_m", rounded(s.path_m)},
          {"places", s.places},
          {"seen_again", s.seen_again},
          {"begin_seen_again", s.begin_seen_again},
          {"parts", s.parts},
          {"loops", s.loops},
          {"hard", hard}};
}

std::vector<Row> summaryRows(const WalkSummary &s) {
  std::vector<Row> rows = {
      {"walked", fixed(s.path_m, 1) + " m", "in " + fixed(s.seconds, 0) + " s"},
      {"frames followed", std::to_string(s.followed), "of " + std::to_string(s.frames) + " that were looked at"},
      {"places", std::to_string(s.places), std::to_string(s.seen_again) + " of them were seen again later"},
      {"loops closed", std::to_string(s.loops),
       s.begin_seen_again ? "one of them to the begin" : "none of them to the begin"}};
  for (const HardStretch &stretch : s.hard)
    rows.push_back({"hard to map", fixed(stretch.from_s, 1) + " to " + fixed(stretch.to_s, 1) + " s",
                    namesOf(kAdviceWords, stretch.advice)});
  return rows;
}

std::string nextSteps(const WalkSummary &s) {
  std::string text;
  const auto add = [&](const std::string &what) { text += (text.empty() ? "" : "\n") + what; };
  if (hasLostStretches(s))
    add("Walk the stretches again that are lost, slowly, and begin at what was seen before them.");
  if (s.loops == 0)
    add("The walk closed no loop, so nothing tells how far it drifts: end it where it began, with the same view.");
  return text;
}

}  // namespace sphc::host
