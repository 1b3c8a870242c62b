#include "host/audit/attack/real_or_fake.h"

#include "host/audit/score/attacks/attacks.h"
#include "host/audit/score/audit_context.h"

namespace sphc::host {
namespace {

Measurement aucOf(const AuditContext &context, double strongest) {
  if (context.eta() < 1) return {"real_or_fake.auc", strongest};
  return {"real_or_fake.auc", {}, "every entry is real: there is no fake to be told from it"};
}

AttackResult runRealOrFake(AuditContext *context) {
  const RealOrFakeScores &strongest = context->realOrFake().scores.back();
  context->tellDone(0.5);
  AttackResult result = {{aucOf(*context, strongest.auc),
                          {"real_or_fake.precision_at_eta", strongest.precision_at_eta,
                           "eta is " + std::to_string(context->eta()).substr(0, 5)},
                          {"real_or_fake.first_tenth", strongest.precision_at_tenth},
                          {"real_or_fake.auc_paper", context->paper().study.scores.back().auc}}};
  result.measurements.push_back(
      strongest.auc_of_layers > 0
          ? Measurement{"real_or_fake.auc_of_layers", strongest.auc_of_layers}
          : Measurement{"real_or_fake.auc_of_layers", {}, "the paper's fakes lie in no stacks, which have layers"});
  result.real_or_fake = context->realOrFake().scores;
  return result;
}

}  // namespace

Attack realOrFakeAttack() {
  return {"real_or_fake",
          {Need::kTruth, Need::kNetworks},
          {{"real_or_fake.auc", "telling real from fake entries; 0.5 is chance", 0.60},
           {"real_or_fake.precision_at_eta", "real among as many as there are, by whoever does it best", {}},
           {"real_or_fake.first_tenth", "real among the tenth that is scored highest, by whoever does it best", {}},
           {"real_or_fake.auc_of_layers", "the same as auc, had somebody separated the layers of stacks", {}},
           {"real_or_fake.auc_paper", "auc, had the paper's fakes been used", {}}},
          runRealOrFake};
}

}  // namespace sphc::host
