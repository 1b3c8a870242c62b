#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lab/rig/run.h"

namespace sphc::host {

std::string rigText(const std::vector<RigRow> &rows);
nlohmann::ordered_json rigJson(const std::vector<RigRow> &rows);

}  // namespace sphc::host
