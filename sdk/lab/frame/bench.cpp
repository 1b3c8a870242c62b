#include "lab/frame/bench.h"

#include <limits>

#include "lab/common/interleave.h"

namespace sphc::host {
namespace {

struct Present {
  const FrameVariant *variant;
  uint32_t repeats;
};

double medianOf(const std::vector<FrameAnswer> &answers, Stage stage) {
  std::vector<double> values;
  for (const FrameAnswer &answer : answers) values.push_back(answer.stages[stage]);
  return percentile(std::move(values), 0.5);
}

FrameAnswer runOnce(const FrameVariant &variant, const FrameCase &frame, uint32_t repeat) {
  FrameAnswer answer = variant.run(frame, repeat);
  answer.stages[kTotal] = answer.pose.seconds;
  return answer;
}

void addFrame(const std::vector<FrameAnswer> &answers, const Rigid &truth, FrameRuns *runs) {
  PoseSample sample;
  judgePose(answers[0].pose, truth, &sample);
  StageSeconds stages;
  for (size_t stage = 0; stage < kStageCount; ++stage) stages[stage] = medianOf(answers, static_cast<Stage>(stage));
  sample.seconds = stages[kTotal];
  runs->poses.samples.push_back(sample);
  runs->stages.push_back(stages);
}

void runFrame(const FrameCase &frame, uint32_t repeats, Random *random, std::vector<Present> *present,
              std::vector<FrameRuns> *runs) {
  std::vector<std::vector<FrameAnswer>> answers(present->size());
  for (uint32_t repeat = 0; repeat < repeats; ++repeat) {
    for (const size_t chosen : shuffledOrder(present->size(), random)) {
      Present &each = (*present)[chosen];
      if (repeat >= each.repeats) continue;
      answers[chosen].push_back(runOnce(*each.variant, frame, repeat));
      const bool first = (*runs)[chosen].poses.samples.empty() && repeat == 0;
      if (first && answers[chosen][0].pose.seconds > kSlowS) each.repeats = 1;
    }
  }
  for (size_t i = 0; i < answers.size(); ++i) addFrame(answers[i], frame.truth_camera_from_world, &(*runs)[i]);
}

double stageMedianMs(const FrameRuns &runs, size_t stage) {
  std::vector<double> values;
  for (const StageSeconds &stages : runs.stages) values.push_back(1e3 * stages[stage]);
  return percentile(std::move(values), 0.5);
}

}  // namespace

const char kFramePeerName[] = "opencv sift, faiss ivf 16";

std::vector<FrameRuns> runFrameBench(const FrameBenchInput &input, const std::vector<FrameVariant> &variants,
                                     const QueryDone &frame_done) {
  std::vector<Present> present;
  std::vector<FrameRuns> runs;
  for (const FrameVariant &variant : variants) {
    if (!variant.run) continue;
    present.push_back({&variant, input.repeats});
    runs.push_back({{variant.name, {}}, {}, variant.memory});
  }
  Random random(1);
  for (uint32_t i = 0; i < input.frames; ++i) {
    FrameCase frame;
    if (input.read(i, &frame)) runFrame(frame, input.repeats, &random, &present, &runs);
    if (frame_done) frame_done(i + 1, input.frames);
  }
  return runs;
}

std::vector<FrameSummary> summarizeFrameBench(const std::vector<FrameRuns> &runs) {
  std::vector<FrameSummary> summaries;
  double peer_ms = std::numeric_limits<double>::quiet_NaN();
  for (const FrameRuns &variant : runs) {
    FrameSummary summary = {summarizeVariant(variant.poses), {}, variant.memory};
    for (size_t stage = 0; stage < kStageCount; ++stage) summary.stage_ms[stage] = stageMedianMs(variant, stage);
    summaries.push_back(summary);
    if (summary.pose.name == kFramePeerName) peer_ms = summary.pose.time_ms.median;
  }
  for (FrameSummary &summary : summaries) summary.times_faster = peer_ms / summary.pose.time_ms.median;
  return summaries;
}

}  // namespace sphc::host
