// What the features bench shows: a table for people, a results and JSON for programs.
#pragma once
#include <nlohmann/json.hpp>

#include "lab/features/bench.h"

namespace sphc::host {

struct FeaturesTable {
  std::string recording;
  size_t frames = 0;
  std::vector<FeaturesSummary> summaries;
};

std::string featuresText(const FeaturesTable &table);
// No milliseconds, which are of one machine; time as a ratio to OpenCV's SIFT.
std::string featuresResults(const std::vector<FeaturesTable> &tables);
nlohmann::ordered_json featuresJson(const std::vector<FeaturesTable> &tables);

}  // namespace sphc::host
