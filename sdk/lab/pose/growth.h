// How the cost grows: with the number of correspondences and with the share of fakes.
#pragma once
#include <nlohmann/json.hpp>

#include "lab/pose/bench.h"

namespace sphc::host {

enum class GrowthAxis { kCount, kEta };

struct GrowthRow {
  std::string file;
  GrowthAxis axis;
  std::string how;  // how the cases were made: "as they are", "chosen or copied", "turned", "added"
  double x;         // rows with depth, or eta in percent
  DepthSource depth;
  std::vector<VariantSummary> summaries;
};

struct GrowthInput {
  std::string file;  // name for the tables
  std::vector<PoseCase> cases;
  DepthSource depth;
  CaseNoise noise;
};

// 100 to 4000 rows at the file's eta.
std::vector<GrowthRow> growCounts(const GrowthInput &input, const std::vector<PoseVariant> &variants,
                                  const BenchOptions &options, const QueryDone &done);
// The file's eta, and, when it is at most 33 %, 15 and 10 % made from it in both ways.
std::vector<GrowthRow> growEtas(const GrowthInput &input, const std::vector<PoseVariant> &variants,
                                const BenchOptions &options, const QueryDone &done);

std::string growthText(const std::vector<GrowthRow> &rows);
std::string growthCsv(const std::vector<GrowthRow> &rows);
std::string growthResults(const std::vector<GrowthRow> &rows);  // ratios, no milliseconds
nlohmann::ordered_json growthJson(const std::vector<GrowthRow> &rows);

}  // namespace sphc::host
