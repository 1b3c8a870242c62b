// The bench of matchers as text, csv, results and JSON.
#pragma once
#include <nlohmann/json.hpp>

#include "lab/match/bench.h"

namespace sphc::host {

std::string matchTableText(const MatchTable &table);
std::string matchCsv(const std::vector<MatchTable> &tables);
std::string matchResults(const std::vector<MatchTable> &tables);  // recalls and ratios, no milliseconds
nlohmann::ordered_json matchJson(const std::vector<MatchTable> &tables);

}  // namespace sphc::host
