// Rows of the bench of predictions in words and as JSON.
#pragma once
#include <nlohmann/json.hpp>

#include "lab/predict/run.h"

namespace sphc::host {

std::string predictText(const std::vector<PredictRow> &rows);
nlohmann::ordered_json predictJson(const std::vector<PredictRow> &rows);

}  // namespace sphc::host
