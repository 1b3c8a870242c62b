// The paper's table 2 of one input: for people, for programs, for the results.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lab/pose/bench.h"

namespace sphc::host {

struct CompareTable {
  std::string input;
  DepthSource depth = DepthSource::kTof;
  size_t queries = 0;
  std::string reference;  // the system whose time is 1
  std::vector<VariantSummary> systems;
};

std::string compareText(const CompareTable &table);
nlohmann::ordered_json compareJson(const CompareTable &table);

// No milliseconds, which are of one machine; time as a ratio to the reference's.
extern const char kCompareHead[];
std::vector<std::string> compareRows(const CompareTable &table);
// What the rows of this table begin with.
std::string compareKey(const CompareTable &table);

}  // namespace sphc::host
