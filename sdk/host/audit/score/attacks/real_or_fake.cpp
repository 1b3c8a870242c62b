#include "host/audit/attack/real_or_fake.h"

#include "host/audit/score/attacks/attacks.h"
#include "host/audit/score/audit_context.h"

namespace sphc::host {
namespace {

AttackResult runRealOrFake(AuditContext *context) {
  const RealOrFakeScores &strongest = context->realOrFake().scores.back();
  return {{{"real_or_fake.auc", strongest.auc},
           {"real_or_fake.precision_at_eta", strongest.precision_at_eta,
            "eta is " + std::to_string(context->eta()).substr(0, 5)},
           {"real_or_fake.auc_paper", context->paper().study.scores.back().auc}}};
}

}  // namespace

Attack realOrFakeAttack() {
  return {"real_or_fake",
          {Need::kTruth, Need::kNetworks},
          {{"real_or_fake.auc", "telling real from fake entries; 0.5 is chance", 0.60},
           {"real_or_fake.precision_at_eta", "real among as many as there are, by the strongest", {}},
           {"real_or_fake.auc_paper", "the same, had the paper's fakes been used", {}}},
          runRealOrFake};
}

}  // namespace sphc::host
