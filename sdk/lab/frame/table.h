// What a run of the frame bench shows: a table for people, csv and JSON for programs.
#pragma once
#include <nlohmann/json.hpp>

#include "lab/frame/bench.h"

namespace sphc::host {

// All variants on one recording with one map.
struct FrameTable {
  std::string recording, map;  // names for the reader
  uint32_t points = 0;         // of the map
  size_t frames = 0;
  std::vector<FrameRuns> runs;
  std::vector<FrameSummary> summaries;
};

std::string frameTableText(const FrameTable &table);
std::string frameCsv(const std::vector<FrameTable> &tables);
// No milliseconds, which are of one machine: times as ratios to the reference peer's, accuracy, and bytes.
std::string frameResults(const std::vector<FrameTable> &tables);
nlohmann::ordered_json frameJson(const std::vector<FrameTable> &tables);
// Median time of a frame against the points of the map, a column a map; "" for a single map.
std::string frameScalingText(const std::vector<FrameTable> &tables);

}  // namespace sphc::host
