#include "host/audit/score/map_audit.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "host/audit/score/attacks/attacks.h"
#include "host/audit/score/audit_context.h"

namespace sphc::host {
namespace {

struct NeedWords {
  Need need;
  const char *name, *cure;
};
constexpr NeedWords kNeeds[] = {{Need::kTruth, "truth", "needs --truth"},
                                {Need::kRecording, "recording", "needs --recording"},
                                {Need::kNetworks, "networks", "needs the attackers' networks (--networks)"},
                                {Need::kReleases, "releases", "needs the other releases of the place (--release)"}};

const NeedWords &wordsOf(Need need) {
  return *std::find_if(std::begin(kNeeds), std::end(kNeeds), [need](const NeedWords &n) { return n.need == need; });
}

bool contains(const std::vector<std::string> &names, const std::string &name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool isMet(Need need, const AuditInput &input) {
  switch (need) {
    case Need::kTruth:
      return input.place.has_value();
    case Need::kRecording:
      return !input.queries.empty();
    case Need::kNetworks:
      return !input.networks.empty();
    case Need::kReleases:
      break;
  }
  return !input.releases.empty();
}

// By the rules: the figure, its attack, or one of the needs in question may be left out.
bool mayStayUnmeasured(const AuditRules &rules, const Attack &attack, const FigureKind &kind,
                       const std::vector<Need> &missing) {
  const auto &allowed = rules.allow_unmeasured;
  return !kind.limit || contains(allowed, kind.name) || contains(allowed, attack.name) ||
         std::any_of(missing.begin(), missing.end(),
                     [&](Need need) { return contains(allowed, wordsOf(need).name); });
}

class MapAuditor {
 public:
  MapAuditor(const AuditInput &input, const AuditRules &rules, const AuditProgress &progress)
      : rules_(rules), progress_(progress), context_(input, [this](double share) { tell(share); }) {
    audit_.quick = input.quick;
  }

  MapAudit run() {
    for (Attack &attack : attacks_) {
      for (FigureKind &kind : attack.figures)
        if (const auto limit = rules_.limits.find(kind.name); limit != rules_.limits.end())
          kind.limit = limit->second;
      run(attack);
      ++done_;
      tell(0);
    }
    return std::move(audit_);
  }

 private:
  // Of the attack that runs.
  void tell(double share) const {
    const double all = 100 * (static_cast<double>(done_) + share) / static_cast<double>(attacks_.size());
    progress_(static_cast<uint32_t>(all), 100);
  }

  void run(const Attack &attack) {
    if (!rules_.only.empty() && !contains(rules_.only, attack.name)) {
      leaveOut(attack, {}, "left out by --only");
      return;
    }
    std::vector<Need> missing;
    for (Need need : attack.needs)
      if (!isMet(need, context_.input())) missing.push_back(need);
    if (missing.empty()) {
      measure(attack);
    } else if (missing.front() == Need::kReleases && context_.input().place && !context_.releasesNotGiven()) {
      for (const FigureKind &kind : attack.figures)
        audit_.figures.push_back({kind, {}, 0, "the ledger knows no other release", false, true});
    } else {
      leaveOut(attack, missing, wordsOf(missing.front()).cure);
    }
  }

  void measure(const Attack &attack) {
    AttackResult result = attack.run(&context_);
    for (const Measurement &measured : result.measurements) {
      const auto kind = std::find_if(attack.figures.begin(), attack.figures.end(),
                                     [&](const FigureKind &k) { return k.name == measured.figure; });
      audit_.figures.push_back({*kind, measured.value, measured.standard_error, measured.remark, true,
                                !measured.value && mayStayUnmeasured(rules_, attack, *kind, {})});
    }
    if (!result.views.empty()) audit_.views = std::move(result.views);
    if (!result.real_or_fake.empty()) audit_.real_or_fake = std::move(result.real_or_fake);
    std::move(result.inversions.begin(), result.inversions.end(), std::back_inserter(audit_.inversions));
    const bool needs_releases =
        std::find(attack.needs.begin(), attack.needs.end(), Need::kReleases) != attack.needs.end();
    if (needs_releases && context_.releasesNotGiven())
      leaveOut(
          attack, {Need::kReleases},
          std::to_string(context_.releasesNotGiven()) + " more releases of the ledger are not given (--release)");
  }

  void leaveOut(const Attack &attack, const std::vector<Need> &missing, const std::string &why) {
    for (const FigureKind &kind : attack.figures)
      audit_.figures.push_back({kind, {}, 0, why, true, mayStayUnmeasured(rules_, attack, kind, missing)});
  }

  const AuditRules &rules_;
  const AuditProgress &progress_;
  std::vector<Attack> attacks_ = allAttacks();
  size_t done_ = 0;  // of these
  AuditContext context_;
  MapAudit audit_;
};

std::vector<std::string> unmeasuredGates(const MapAudit &audit, bool allowed) {
  std::vector<std::string> names;
  for (const AuditFigure &figure : audit.figures)
    if (figure.kind.limit && figure.verdict() == Verdict::kNotMeasured && figure.may_stay_unmeasured == allowed &&
        !contains(names, figure.kind.name))
      names.push_back(figure.kind.name);
  return names;
}

}  // namespace

void checkRules(const AuditRules &rules) {
  std::vector<std::string> figures, others, attacks;
  for (const NeedWords &need : kNeeds) others.push_back(need.name);
  for (const Attack &attack : allAttacks()) {
    attacks.push_back(attack.name);
    others.push_back(attack.name);
    for (const FigureKind &kind : attack.figures) figures.push_back(kind.name);
  }
  for (const auto &[name, value] : rules.limits)
    if (!contains(figures, name))
      throw std::runtime_error("no figure is named " + name + "; audit prints their names");
  for (const std::string &name : rules.only)
    if (!contains(attacks, name))
      throw std::runtime_error("no attack is named " + name + "; docs/audit.md has a table of them");
  for (const std::string &name : rules.allow_unmeasured)
    if (!contains(figures, name) && !contains(others, name))
      throw std::runtime_error(
          "nothing is named " + name +
          "; --allow-unmeasured takes a figure, an attack (the word before a figure's dot), or "
          "truth, recording, networks, releases");
}

Verdict AuditFigure::verdict() const {
  if (!applies) return Verdict::kDoesNotApply;
  if (!value) return Verdict::kNotMeasured;
  if (!kind.limit) return Verdict::kInformation;
  return (kind.at_most ? *value <= *kind.limit : *value >= *kind.limit) ? Verdict::kHolds : Verdict::kBroken;
}

std::vector<std::string> MapAudit::missingGates() const { return unmeasuredGates(*this, false); }
std::vector<std::string> MapAudit::allowedGates() const { return unmeasuredGates(*this, true); }

AuditOutcome MapAudit::outcome() const {
  const bool broken = std::any_of(figures.begin(), figures.end(),
                                  [](const AuditFigure &figure) { return figure.verdict() == Verdict::kBroken; });
  if (broken) return AuditOutcome::kBroken;
  return missingGates().empty() ? AuditOutcome::kHolds : AuditOutcome::kNotMeasured;
}

MapAudit auditMap(const AuditInput &input, const AuditRules &rules, const AuditProgress &progress) {
  checkRules(rules);
  return MapAuditor(input, rules, progress).run();
}

}  // namespace sphc::host
