// Cold frames by one core and by several: how much sooner are they answered, and is it the same answer?
#pragma once
#include <vector>

#include "host/evaluate/map_file.h"
#include "lab/negative/sequence.h"

namespace sphc::host {

struct ParallelInput {
  Sequence sequence;
  const std::vector<MapFile> *maps = nullptr;
  std::vector<uint32_t> threads;
  uint32_t repeats = 1;
};

// Medians over the frames, of the median of a frame's repeats.
struct FrameTimes {
  double total_ms = 0, features_ms = 0, match_ms = 0;
};

struct ParallelRow {
  uint32_t threads = 1;           // 1: without config.parallel
  uint32_t frames = 0, same = 0;  // whose result is that of one thread, to the last bit but for times
  FrameTimes times;
  uint64_t scratch_bytes = 0;
};

// Every frame by each number of threads in turn, in a random order, one thread being the first row.
std::vector<ParallelRow> runParallel(const ParallelInput &input);

}  // namespace sphc::host
