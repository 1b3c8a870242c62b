// All attacks on one map, each with a verdict: what `spherecloud audit` runs before a release.
#pragma once
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/audit/score/attack.h"
#include "host/audit/score/audit_input.h"

namespace sphc::host {

struct AuditRules {
  std::map<std::string, double> limits;  // by figure, beside or in place of its own
  // What may stay unmeasured: names of figures, of attacks, or of needs (truth, recording, networks, releases).
  std::vector<std::string> allow_unmeasured;
  std::vector<std::string> only;  // attacks to run; empty: all.  The others are not measured.
};

// Throws std::runtime_error when a name of the rules is none.
void checkRules(const AuditRules &rules);

enum class Verdict { kHolds, kBroken, kInformation, kNotMeasured, kDoesNotApply };

struct AuditFigure {
  FigureKind kind;  // with the limit of the rules
  std::optional<double> value;
  double standard_error = 0;
  std::string remark;                // what it is of, or why it was not measured
  bool applies = true;               // else there is nothing to attack
  bool may_stay_unmeasured = false;  // by the rules, or as information

  Verdict verdict() const;
};

// Of all figures together; a gate that was not measured fails closed.
enum class AuditOutcome { kHolds, kBroken, kNotMeasured };

struct MapAudit {
  bool quick = false;
  std::vector<AuditFigure> figures;
  std::vector<InversionView> views;
  std::vector<InversionResult> inversions;
  std::vector<RealOrFakeScores> real_or_fake;

  AuditOutcome outcome() const;
  std::vector<std::string> missingGates() const;  // not measured, and nobody allowed it
  std::vector<std::string> allowedGates() const;  // not measured, as the rules allow
};

// Told after each attack, and each step of the long ones, how much is done: per cent, of 100.
using AuditProgress = std::function<void(uint32_t done, uint32_t total)>;

// Throws std::runtime_error, with cause and cure, when the map cannot be read or is not of the place, or by
// checkRules.
MapAudit auditMap(const AuditInput &input, const AuditRules &rules, const AuditProgress &progress);

}  // namespace sphc::host
