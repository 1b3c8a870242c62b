// One interleaved run over the frames of a recording: every frame through every variant in turn.
#pragma once
#include "lab/frame/variant.h"
#include "lab/pose/bench.h"

namespace sphc::host {

struct FrameRuns {
  VariantRuns poses;                 // a sample a frame; its time is the median of the repeats
  std::vector<StageSeconds> stages;  // a frame each; medians too
  FrameMemory memory;
};

// Fills the case of a frame, valid until the next call; false when it cannot be used.
using ReadFrame = std::function<bool(uint32_t index, FrameCase *frame)>;

struct FrameBenchInput {
  uint32_t frames = 0, repeats = 1;
  ReadFrame read;
};

// Absent variants are left out.  A variant that is slow (kSlowS) on the first frame runs once a frame.
std::vector<FrameRuns> runFrameBench(const FrameBenchInput &input, const std::vector<FrameVariant> &variants,
                                     const QueryDone &frame_done);

struct FrameSummary {
  VariantSummary pose;                       // time_ms is the whole frame's
  std::array<double, kStageCount> stage_ms;  // medians
  FrameMemory memory;
  double times_faster = 0;  // than the reference peer, by the medians of this run; NaN without it
};

// The peer that times are stated as ratios to.
extern const char kFramePeerName[];
std::vector<FrameSummary> summarizeFrameBench(const std::vector<FrameRuns> &runs);

}  // namespace sphc::host
