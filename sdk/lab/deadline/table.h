// Rows of the deadline bench in words and as JSON.
#pragma once
#include <nlohmann/json.hpp>

#include "lab/deadline/run.h"

namespace sphc::host {

std::string deadlineText(const std::vector<DeadlineRow> &rows);
nlohmann::ordered_json deadlineJson(const std::vector<DeadlineRow> &rows);

}  // namespace sphc::host
