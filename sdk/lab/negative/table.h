// Rows of the negative suite in words and as JSON.
#pragma once
#include <nlohmann/json.hpp>

#include "lab/negative/run.h"

namespace sphc::host {

std::string negativeText(const std::vector<NegativeRow> &rows);
nlohmann::ordered_json negativeJson(const std::vector<NegativeRow> &rows);

}  // namespace sphc::host
