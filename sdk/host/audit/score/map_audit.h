// All attacks on one map, each with a verdict: what `spherecloud audit` runs before a release.
#pragma once
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/audit/attack/published.h"
#include "host/audit/score/inversion_audit.h"
#include "host/audit/score/truth.h"
#include "host/publish/place.h"

namespace sphc::host {

struct MapAuditInput {
  std::vector<uint8_t> file;
  std::string networks;                          // folder of the attackers' trained files
  std::optional<Place> place;                    // the owner's truth; without it some attacks cannot be scored
  std::vector<InversionView> views;              // pictures of the place from the centre; else pseudo truth
  std::vector<std::vector<uint8_t>> releases;    // other maps of the place that were published
  std::vector<std::vector<ModelPoint>> queries;  // frames of a client, in the place's frame
  bool quick = false;
};

enum class Verdict { kHolds, kBroken, kInformation, kNotMeasured };

struct AuditFigure {
  std::string name;   // "attack.metric": what a limit is set for
  std::string about;  // a line for people
  std::optional<double> value;
  double standard_error = 0;
  std::optional<double> limit;
  bool at_most = true;  // else at least
  std::string remark;   // why it was not measured, or what it is of
  Verdict verdict() const;
};

struct MapAudit {
  std::vector<AuditFigure> figures;
  std::vector<InversionView> views;
  std::vector<InversionResult> inversions;
  bool holds() const;  // no figure is broken
};

// Limits by figure name; those of a release unless the user has others.
std::map<std::string, double> defaultAuditLimits();

// Told the name of each attack before it begins.
using AuditProgress = std::function<void(const std::string &attack)>;

// Throws std::runtime_error, with cause and cure, when the map cannot be read or is not of the place, or a limit
// has no figure.
MapAudit auditMap(const MapAuditInput &input, const std::map<std::string, double> &limits,
                  const AuditProgress &progress);

}  // namespace sphc::host
