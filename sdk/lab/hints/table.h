// Rows of the bench of hints in words and as JSON.
#pragma once
#include <nlohmann/json.hpp>

#include "lab/hints/run.h"

namespace sphc::host {

std::string hintText(const std::vector<HintRow> &rows);
nlohmann::ordered_json hintJson(const std::vector<HintRow> &rows);

}  // namespace sphc::host
