// The audit as a web page: verdicts, and what inverted pictures show beside the truth.
#pragma once
#include <string>

#include "host/audit/score/map_audit.h"

namespace sphc::host {

// Writes FOLDER/audit.html, which needs nothing else, and FOLDER/inversion.png.  Gives the page's path.  Throws
// std::runtime_error when the folder cannot be written.
std::string writeAuditPage(const std::string &folder, const std::string &map, const MapAudit &audit);

// The figure's verdict in a word or two; capitals for what stops a release.
std::string wordFor(const AuditFigure &figure);
// What the owner is to make of it.
std::string outcomeText(const MapAudit &audit);

}  // namespace sphc::host
