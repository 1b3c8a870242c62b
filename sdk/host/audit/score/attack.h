// An attack as the audit knows it: a value with a name, needs, figures and a function.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/audit/score/inversion_audit.h"
#include "host/audit/score/real_or_fake_scores.h"

namespace sphc::host {

class AuditContext;

// What an attack may need beside the map file.
enum class Need { kTruth, kRecording, kNetworks, kReleases };

struct FigureKind {
  std::string name;             // "attack.metric": what a limit is set for
  std::string about;            // a line for people
  std::optional<double> limit;  // a figure with a limit is a gate: it must be measured, and hold
  bool at_most = true;          // else at least
};

struct Measurement {
  std::string figure;           // the name of one of the attack's kinds
  std::optional<double> value;  // none: it could not be measured, and the remark says why
  std::string remark = {};
  double standard_error = 0;
};

struct AttackResult {
  std::vector<Measurement> measurements;
  // What inverted pictures show, for people to look at.
  std::vector<InversionView> views = {};
  std::vector<InversionResult> inversions = {};
  std::vector<RealOrFakeScores> real_or_fake = {};  // an attacker each
};

struct Attack {
  std::string name;
  std::vector<Need> needs;
  std::vector<FigureKind> figures;
  // Called only when all needs are met.  Throws std::runtime_error with cause and cure.
  std::function<AttackResult(AuditContext *context)> run;
};

}  // namespace sphc::host
