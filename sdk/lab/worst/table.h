// Rows of the bench of worst cases in words and as JSON.
#pragma once
#include <nlohmann/json.hpp>

#include "lab/worst/run.h"

namespace sphc::host {

std::string worstText(const std::vector<WorstRow> &rows);
nlohmann::ordered_json worstJson(const std::vector<WorstRow> &rows);

}  // namespace sphc::host
