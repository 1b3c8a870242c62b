// Where the attackers' networks lie.
#pragma once
#include <string>

namespace sphc::host {

// share/spherecloud/networks beside this program's folder, as it is installed and as the build tree has it; empty
// when there is none.
std::string auditNetworks();

}  // namespace sphc::host
