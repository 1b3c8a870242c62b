// That a page of the docs explains what the command says to programs.
#pragma once
#include <nlohmann/json.hpp>

namespace sphc::host {

// Every key, however deep, stands in docs/cli.md, and so does every name by which outcomes, faults and hints are
// counted.
void expectExplained(const nlohmann::json &json);

}  // namespace sphc::host
