// The audit as a web page: verdicts, and what inverted pictures show beside the truth.
#pragma once
#include <string>

#include "host/audit/score/map_audit.h"

namespace sphc::host {

// Writes FOLDER/audit.html, which needs nothing else, and FOLDER/inversion.png.  Gives the page's path.  Throws
// std::runtime_error when the folder cannot be written.
std::string writeAuditPage(const std::string &folder, const std::string &map, const MapAudit &audit);

// "holds", "BROKEN", "for information" or "not measured".
std::string wordFor(Verdict verdict);

}  // namespace sphc::host
