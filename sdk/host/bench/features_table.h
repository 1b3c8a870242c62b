// What the features bench shows: a table for people, a ledger and JSON for programs.
#pragma once
#include <nlohmann/json.hpp>

#include "host/bench/features_bench.h"

namespace sphc::host {

struct FeaturesTable {
  std::string recording;
  size_t frames = 0;
  std::vector<FeaturesSummary> summaries;
};

std::string featuresText(const FeaturesTable &table);
// No milliseconds, which are of one machine; time as a ratio to OpenCV's SIFT.
std::string featuresLedger(const std::vector<FeaturesTable> &tables);
nlohmann::ordered_json featuresJson(const std::vector<FeaturesTable> &tables);

}  // namespace sphc::host
