// What `spherecloud map` tells of its outcome: a table, and JSON.
#pragma once
#include <nlohmann/json.hpp>
#include <vector>

#include "host/cli/map_outcome.h"
#include "host/report/table.h"

namespace sphc::host {

std::vector<Row> mapTable(const MapOutcome &outcome);
nlohmann::ordered_json mapJson(const MapOutcome &outcome);

}  // namespace sphc::host
