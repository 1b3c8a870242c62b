// What a run of the bench shows: a table for people, csv and JSON for programs.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lab/pose/bench.h"

namespace sphc::host {

// All variants on one file with one kind of depth.
struct BenchTable {
  std::string file;  // its name without folder and ending
  uint32_t eta_percent = 0;
  DepthSource depth = DepthSource::kTof;
  size_t queries = 0;
  std::vector<VariantRuns> runs;
  std::vector<VariantSummary> summaries;
};

std::string benchTableText(const BenchTable &table);
std::string benchCsv(const std::vector<BenchTable> &tables);
// The results: no milliseconds, which are of one machine; time as a ratio to PoseLib's.
std::string benchResults(const std::vector<BenchTable> &tables);
nlohmann::ordered_json benchJson(const std::vector<BenchTable> &tables);
nlohmann::ordered_json summaryJson(const VariantSummary &summary);

// A field of a csv line, quoted where it must be.
std::string csvText(const std::string &text);

// Columns aligned, the first to the left, the others to the right; the first row is the head.
std::string alignedText(const std::vector<std::vector<std::string>> &rows);

}  // namespace sphc::host
