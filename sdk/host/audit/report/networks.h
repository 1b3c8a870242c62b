// Where the attackers' networks lie.
#pragma once
#include <string>

namespace sphc::host {

// The folder that was installed with this command, else that of the source it was built from.  Throws
// std::runtime_error, which names both, when there is neither.
std::string auditNetworks();

}  // namespace sphc::host
