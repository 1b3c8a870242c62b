// Rows of the bench of threads in words and as JSON.
#pragma once
#include <nlohmann/json.hpp>

#include "lab/parallel/run.h"

namespace sphc::host {

std::string parallelText(const std::vector<ParallelRow> &rows);
nlohmann::ordered_json parallelJson(const std::vector<ParallelRow> &rows);

}  // namespace sphc::host
